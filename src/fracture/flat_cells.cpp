#include "fracture/flat_cells.h"

#include <Eigen/SparseCholesky>

#include "base/check.h"
#include "fracture/piece_meshes.h"

namespace brisance {
namespace {

/// Weights are known but for a constant per connected part: a share of the mean area holds each near zero.
constexpr double hold = 1e-6;

std::vector<double> fittedWeights(const std::vector<Vec3d>& seeds, const std::vector<Contact>& contacts) {
  const auto count = static_cast<Eigen::Index>(seeds.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  double area = 0;
  for (const Contact& c : contacts) {
    const Vec3d toA = c.place - seeds[c.a], toB = c.place - seeds[c.b];
    const double difference = dot(toA, toA) - dot(toB, toB);  // w_a - w_b
    for (const auto& [i, j, sign] : {std::tuple(c.a, c.b, 1.0), std::tuple(c.b, c.a, -1.0)}) {
      entries.push_back({i, i, c.area});
      entries.push_back({i, j, -c.area});
      right[i] += sign * c.area * difference;
    }
    area += c.area;
  }
  for (Eigen::Index i = 0; i < count; ++i)
    entries.push_back({static_cast<int>(i), static_cast<int>(i), hold * area / static_cast<double>(count) + 1e-300});
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) return std::vector<double>(seeds.size(), 0);
  const Eigen::VectorXd weights = solver.solve(right);
  return {weights.data(), weights.data() + count};
}

}  // namespace

FlatCells flatCells(const CellAtoms& atoms, const Partition& pieces) {
  std::vector<double> volume(pieces.count, 0);
  FlatCells cells;
  cells.seeds.assign(pieces.count, {});
  for (std::size_t a = 0; a < atoms.atoms.size(); ++a) {
    const Atom& atom = atoms.atoms[a];
    cells.seeds[pieces.pieceOf[a]] += atom.centroid * atom.volume;
    volume[pieces.pieceOf[a]] += atom.volume;
  }
  for (int p = 0; p < pieces.count; ++p)
    if (volume[p] > 0) cells.seeds[p] = cells.seeds[p] / volume[p];
  cells.weights = fittedWeights(cells.seeds, pieceContacts(atoms, pieces));
  return cells;
}

}  // namespace brisance
