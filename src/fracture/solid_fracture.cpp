#include "fracture/solid_fracture.h"

#include "base/check.h"
#include "base/parallel.h"
#include "fracture/flat_cells.h"
#include "fracture/piece_meshes.h"
#include "fracture/solid_parts.h"
#include "fracture/solid_seeds.h"

namespace brisance {
namespace {

/// A body in cells, and which of them make a piece.
struct Cut {
  CellComplex complex;
  CellAtoms atoms;
  Partition pieces;
};

class SolidBreaker {
 public:
  SolidBreaker(const SolidSurface& surface, const FractureSettings& settings, const SolidFracture& how)
      : surface_(surface), settings_(settings), how_(how) {}

  Cut run() {
    if (cellsPerPiece() == 1) return cellEach();
    Cut rough = fused();
    return settings_.solid.flat ? flattened(rough) : std::move(rough);
  }

 private:
  static constexpr int mostTries = 16;

  int cellsPerPiece() const {
    constexpr int roughCells = 24;
    if (settings_.solid.cellsPerPiece > 0) return settings_.solid.cellsPerPiece;
    return std::holds_alternative<Voronoi>(settings_.method) ? 1 : roughCells;
  }
  std::vector<Vec3d> seeds(int count) const {
    const Voronoi* cells = std::get_if<Voronoi>(&settings_.method);
    return solidSeeds(surface_, cells ? *cells : Voronoi{}, count, settings_.seed);
  }

  /// Cuts until nothing coincides and `divide` is content; `attempt` counts.
  template <class Divide>
  std::optional<Cut> cut(const std::vector<Vec3d>& seeds, const std::vector<double>& weights, const Divide& divide) {
    for (int n = 0; n < mostTries; ++n) {
      try {
        Cut result{cellComplex(surface_, seeds, weights, settings_.seed + shake_++), {}, {}};
        deepestWinding_ = std::max(deepestWinding_, result.complex.deepestWinding);
        result.atoms = cellAtoms(result.complex);
        result.pieces = divide(result);
        if (result.pieces.count < settings_.pieces) return std::nullopt;
        if (piecesAreManifold(result.complex, result.atoms, result.pieces)) return result;
      } catch (const Coincidence&) {
      }
    }
    if (deepestWinding_ > 1)
      throw InputError("solid: the mesh must not cross itself: parts of it overlap and leave pieces open");
    checkFailed("a cut in general position", __FILE__, __LINE__, "");
  }

  /// One cell per piece; where some are empty, more cells.
  Cut cellEach() {
    for (int extra = 0;; extra += 1 + extra) {
      auto result =
          cut(seeds(settings_.pieces + extra), {}, [&](const Cut& c) { return cellPieces(c.atoms, settings_.pieces); });
      if (result) return std::move(*result);
      CHECK(extra < 100 * settings_.pieces, "{} cells yield fewer than {} pieces", extra, settings_.pieces);
    }
  }

  Cut fused() {
    auto result = cut(seeds(settings_.pieces * cellsPerPiece()), {},
                      [&](const Cut& c) { return how_.partition(atomGraph(c.complex, c.atoms, how_.vertexStrength)); });
    CHECK(result, "the partition has fewer than {} pieces", settings_.pieces);
    return std::move(*result);
  }

  /// The same pieces with flat faces; with cells of equal weight where a weighted one is empty.
  Cut flattened(const Cut& rough) {
    const FlatCells cells = flatCells(rough.atoms, rough.pieces);
    const auto divide = [&](const Cut& c) { return cellPieces(c.atoms, settings_.pieces); };
    auto result = cut(cells.seeds, cells.weights, divide);
    if (!result) result = cut(cells.seeds, {}, divide);
    return result ? std::move(*result) : cellEach();
  }

  const SolidSurface& surface_;
  const FractureSettings& settings_;
  const SolidFracture& how_;
  std::uint64_t shake_ = 0;
  int deepestWinding_ = 1;
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

}  // namespace

FracturedBody fractureSolid(const TriangleMesh& input, const FractureSettings& settings, const SolidFracture& how) {
  const TriangleMesh mesh = facingOutwards(input);
  const SolidSurface surface = solidSurface(mesh);
  FracturedBody body;
  body.solid = true;
  if (settings.pieces == 1) {
    body.pieces.push_back(settled(mesh, surface.step));
    return body;
  }
  const Cut cut = SolidBreaker(surface, settings, how).run();
  std::vector<TriangleMesh> meshes = pieceMeshes(mesh, cut.complex, cut.atoms, cut.pieces);
  body.pieces.resize(meshes.size());
  parallelFor(0, static_cast<std::int64_t>(meshes.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t p = begin; p < end; ++p) body.pieces[p] = settled(std::move(meshes[p]), surface.step);
  });
  body.bonds = bondsOf(pieceContacts(cut.atoms, cut.pieces), body.pieces);
  return body;
}

}  // namespace brisance
