#include "fracture/solid_fracture.h"

#include "base/check.h"
#include "base/parallel.h"
#include "fracture/curvature.h"
#include "fracture/flat_cells.h"
#include "fracture/partition.h"
#include "fracture/piece_meshes.h"
#include "fracture/separate_bodies.h"
#include "fracture/solid_parts.h"
#include "fracture/solid_seeds.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

/// A body in cells, and which of them make a piece.
struct SolidCut {
  CellComplex complex;
  CellAtoms atoms;
  Partition pieces;
  std::vector<double> eigenvalues;  ///< of a spectral partition
};

/// Vertices that lie at one place, doubled for their normals or uvs, are one vertex of the surface.
std::vector<double> strengthWithSeams(const TriangleMesh& mesh, CurvatureWeights weights) {
  std::vector<double> strength = vertexStrength(welded(mesh), weights);
  const std::vector<std::uint32_t> first = samePlaces(mesh.vertices);
  for (std::size_t v = 0; v < strength.size(); ++v) strength[v] = strength[first[v]];
  return strength;
}

/// Cuts one body. Without result where the surface crosses itself so that pieces stay open.
class SolidBreaker {
 public:
  SolidBreaker(const TriangleMesh& mesh, const SolidSurface& surface, const FractureSettings& settings)
      : mesh_(mesh), surface_(surface), settings_(settings), pieces_(settings.pieces) {}

  std::optional<SolidCut> run() {
    try {
      if (pieces_ == 1) return whole();
      if (cellsPerPiece() == 1) return cellEach();
      SolidCut rough = fused();
      return settings_.solid.flat ? flattened(rough) : std::move(rough);
    } catch (const Open&) {
      return std::nullopt;
    }
  }

 private:
  static constexpr int mostTries = 8;
  struct Open {};

  int cellsPerPiece() const {
    constexpr int roughCells = 24;
    if (settings_.solid.cellsPerPiece > 0) return settings_.solid.cellsPerPiece;
    return std::holds_alternative<Voronoi>(settings_.method) ? 1 : roughCells;
  }
  std::vector<Vec3d> seeds(int count) const {
    const Voronoi* cells = std::get_if<Voronoi>(&settings_.method);
    return solidSeeds(surface_, cells ? *cells : Voronoi{}, count, settings_.seed);
  }

  /// Shakes the lattice until nothing coincides. Without result if `divide` finds too few pieces.
  template <class Divide>
  std::optional<SolidCut> cut(const std::vector<Vec3d>& seeds, const std::vector<double>& weights,
                              const Divide& divide) {
    for (int n = 0; n < mostTries; ++n) {
      try {
        SolidCut result{cellComplex(surface_, seeds, weights, settings_.seed + shake_++), {}, {}, {}};
        if (result.complex.overlaps) throw Open{};
        result.atoms = cellAtoms(result.complex);
        result.pieces = divide(result);
        if (result.pieces.count < pieces_) return std::nullopt;
        if (piecesAreManifold(result.complex, result.atoms, result.pieces)) return result;
      } catch (const Coincidence&) {
      }
    }
    throw Open{};
  }

  /// One cell around everything, however many parts there are.
  SolidCut whole() {
    const auto all = [](const SolidCut& c) { return Partition{std::vector<int>(c.atoms.atoms.size(), 0), 1}; };
    return std::move(*cut({surface_.places.front()}, {}, all));
  }

  /// One cell per piece; where some are empty, more cells.
  SolidCut cellEach() {
    for (int extra = 0;; extra += 1 + extra) {
      auto result = cut(seeds(pieces_ + extra), {}, [&](const SolidCut& c) { return cellPieces(c.atoms, pieces_); });
      if (result) return std::move(*result);
      CHECK(extra < 100 * pieces_, "{} cells yield fewer than {} pieces", extra, pieces_);
    }
  }

  SolidCut fused() {
    std::vector<double> strength;
    if (const Curvature* curvature = std::get_if<Curvature>(&settings_.method))
      strength = strengthWithSeams(mesh_, curvature->weights);
    auto result = cut(seeds(pieces_ * cellsPerPiece()), {}, [&](SolidCut& c) {
      auto parts = partitionGraph(atomGraph(c.complex, c.atoms, strength), settings_);
      c.eigenvalues = std::move(parts.eigenvalues);
      return std::move(parts.partition);
    });
    CHECK(result, "the partition has fewer than {} pieces", pieces_);
    return std::move(*result);
  }

  /// The same pieces with flat faces; with cells of equal weight where a weighted one is empty.
  SolidCut flattened(const SolidCut& rough) {
    const FlatCells cells = flatCells(rough.atoms, rough.pieces);
    const auto divide = [&](const SolidCut& c) { return cellPieces(c.atoms, pieces_); };
    auto result = cut(cells.seeds, cells.weights, divide);
    if (!result) result = cut(cells.seeds, {}, divide);
    return result ? std::move(*result) : cellEach();
  }

  const TriangleMesh& mesh_;
  const SolidSurface& surface_;
  FractureSettings settings_;
  int pieces_;
  std::uint64_t shake_ = 0;
};

/// About its own centroid, but for rounding that keeps sums with `place` exact.
Piece settled(TriangleMesh mesh, double step) {
  const MassProperties properties = solidProperties(mesh);
  Piece piece{std::move(mesh), properties, onSteps(properties.centroid, step)};
  recenter(piece.mesh, piece.place);
  piece.properties.centroid = {};
  return piece;
}

std::vector<Bond> bondsOf(const std::vector<Contact>& contacts, const std::vector<Piece>& pieces) {
  std::vector<Bond> bonds;
  for (const Contact& c : contacts) {
    // A shared face that closes on itself has no direction: then the one from centroid to centroid.
    constexpr double leastShare = 1e-6;  // of the longest possible sum: below it is rounding
    const bool directed = length(c.normal) > leastShare * c.area;
    bonds.push_back(
        {c.a, c.b, c.area, normalized(directed ? c.normal : pieces[c.b].place - pieces[c.a].place), c.place});
  }
  return bonds;
}

/// Turned right side out.
TriangleMesh facingOutwards(TriangleMesh mesh) {
  if (solidProperties(mesh).volume >= 0) return mesh;
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  for (Vec3d& normal : mesh.normals) normal = -normal;
  return mesh;
}

/// Pieces of a cut, moved to their centroids.
FracturedBody bodyOf(const TriangleMesh& mesh, const SolidCut& cut, double step) {
  FracturedBody body;
  body.solid = true;
  body.eigenvalues = cut.eigenvalues;
  std::vector<TriangleMesh> meshes = pieceMeshes(mesh, cut.complex, cut.atoms, cut.pieces);
  body.pieces.resize(meshes.size());
  parallelFor(0, static_cast<std::int64_t>(meshes.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t p = begin; p < end; ++p) body.pieces[p] = settled(std::move(meshes[p]), step);
  });
  body.bonds = bondsOf(pieceContacts(cut.atoms, cut.pieces), body.pieces);
  return body;
}

void append(FracturedBody& all, FracturedBody part) {
  const int shift = static_cast<int>(all.pieces.size());
  for (Bond bond : part.bonds) {
    bond.a += shift;
    bond.b += shift;
    all.bonds.push_back(bond);
  }
  for (Piece& piece : part.pieces) all.pieces.push_back(std::move(piece));
}

/// Bodies that overlap one another, each cut for itself.
FracturedBody cutSeparately(const TriangleMesh& mesh, const SolidSurface& surface, const FractureSettings& settings) {
  const std::vector<TriangleMesh> bodies = separateBodies(mesh, surface);
  const std::vector<int> share = piecesOfBodies(bodies, settings.pieces);
  FracturedBody all;
  all.solid = true;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const SolidSurface own = solidSurface(bodies[b]);
    FractureSettings ownSettings = settings;
    ownSettings.pieces = share[b];
    const auto cut = bodies.size() > 1 ? SolidBreaker(bodies[b], own, ownSettings).run() : std::nullopt;
    if (!cut) throw InputError("solid: the mesh must not cross itself: a part of it does, and would leave pieces open");
    append(all, bodyOf(bodies[b], *cut, own.step));
  }
  return all;
}

}  // namespace

FracturedBody fractureSolid(const TriangleMesh& input, const FractureSettings& settings) {
  const TriangleMesh mesh = facingOutwards(input);
  const SolidSurface surface = solidSurface(mesh);
  const auto cut = SolidBreaker(mesh, surface, settings).run();
  return cut ? bodyOf(mesh, *cut, surface.step) : cutSeparately(mesh, surface, settings);
}

}  // namespace brisance
