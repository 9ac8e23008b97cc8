#include "fracture/solid_fracture.h"

#include <gtest/gtest.h>

#include "assets/sample_meshes.h"
#include "base/check.h"
#include "base/parallel.h"
#include "fracture/solid_checker.h"
#include "fracture/solid_shapes.h"
#include "mesh/convex_hull.h"
#include "mesh/mesh_topology.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {

FractureSettings settingsOf(const FractureMethod& method, int pieces, std::uint64_t seed = 1) {
  FractureSettings settings;
  settings.method = method;
  settings.pieces = pieces;
  settings.seed = seed;
  settings.solid.enabled = true;
  return settings;
}
FractureSettings flatCells(int pieces, std::uint64_t seed = 1) { return settingsOf(Voronoi{}, pieces, seed); }
FractureSettings rough(int pieces, std::uint64_t seed = 1) { return settingsOf(BreadthFirst{}, pieces, seed); }
FractureSettings flattened(int pieces, std::uint64_t seed = 1) {
  FractureSettings settings = rough(pieces, seed);
  settings.solid.flat = true;
  return settings;
}

void expectSolidPieces(const TriangleMesh& mesh, const FractureSettings& settings) {
  const FracturedBody body = fractureSolid(mesh, settings);
  EXPECT_EQ(solid_checker::fault(body, solid_checker::volumeOf(mesh)), "");
  EXPECT_EQ(static_cast<int>(body.pieces.size()), settings.pieces);
}

TEST(SolidFracture, TwoHundredSeedsOnEveryShapeGiveSolidsThatMakeUpTheWhole) {
  for (const auto& [name, mesh] : solid_shapes::all())
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      SCOPED_TRACE(name + ", seed " + std::to_string(seed));
      const int pieces = 2 + static_cast<int>(seed % 13);
      expectSolidPieces(mesh, seed % 3 == 0   ? rough(pieces, seed)
                              : seed % 3 == 1 ? flatCells(pieces, seed)
                                              : flattened(pieces, seed));
      if (HasFailure()) return;
    }
}

TEST(SolidFracture, ACubeCutInTwoHasOneFlatFaceThatBothShare) {
  const FracturedBody body = fractureSolid(boxMesh({1, 1, 1}, false), flatCells(2));
  ASSERT_EQ(body.pieces.size(), 2u);
  ASSERT_EQ(body.bonds.size(), 1u);
  const Bond& bond = body.bonds[0];
  EXPECT_NEAR(length(bond.normal), 1, 1e-12);
  EXPECT_GT(dot(bond.normal, body.pieces[1].place - body.pieces[0].place), 0);
  EXPECT_TRUE(body.solid);
  // The seeds' plane is shaken by 1e-5 of the box; its own vertices lie on it to the shaking of vertices, 3e-11.
  double area = 0;
  for (const Piece& piece : body.pieces) {
    const auto triangles = solid_checker::trianglesOf(piece);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (piece.mesh.materialNames[piece.mesh.materials[t]] != "inside") continue;
      Vec3d corner[3];
      for (int k = 0; k < 3; ++k) {
        corner[k] = {triangles[t][k][0], triangles[t][k][1], triangles[t][k][2]};
        EXPECT_NEAR(dot(corner[k] - bond.place, bond.normal), 0, 1e-9);
      }
      area += length(cross(corner[1] - corner[0], corner[2] - corner[0])) / 4;  // half, and met from both sides
    }
  }
  EXPECT_NEAR(area, bond.area, 1e-9);
  // The largest plane section of a unit cube.
  EXPECT_LE(bond.area, std::sqrt(2.0) + 1e-9);
}

TEST(SolidFracture, EveryPieceHasOneOuterSurface) {
  for (const auto& settings : {flatCells(30), rough(30), flattened(30)})
    for (const Piece& piece : fractureSolid(samples::torus(2000), settings).pieces)
      EXPECT_EQ(componentCount(piece.mesh), 1);
}

/// A planar map of space: what it says of a corner must hold at every vertex that a cut makes.
Vec2d mapOf(const Vec3d& p) { return {0.3 * p.x + 0.1 * p.y - 0.4 * p.z + 2, 0.2 * p.y + 0.5 * p.z}; }

TEST(SolidFracture, OutsideFacesKeepTheirTextureNormalsAndMaterials) {
  TriangleMesh mesh = boxMesh({1, 2, 3}, true);  // vertices doubled along its edges
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.uvs[v] = mapOf(mesh.vertices[v]);
  mesh.normals.clear();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.normals.push_back({});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3d n = normalized(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
    for (const std::uint32_t v : {a, b, c}) mesh.normals[v] = n;
    mesh.materials.push_back(std::abs(n.x) > 0.5 ? 1 : 0);
  }
  mesh.materialNames = {"paint", "wood"};
  const FracturedBody body = fractureSolid(mesh, flatCells(12));
  EXPECT_EQ(solid_checker::fault(body, 6), "");
  for (const Piece& piece : body.pieces) {
    ASSERT_EQ(piece.mesh.materialNames, (std::vector<std::string>{"paint", "wood", "inside"}));
    ASSERT_EQ(piece.mesh.uvs.size(), piece.mesh.vertices.size());
    ASSERT_EQ(piece.mesh.normals.size(), piece.mesh.vertices.size());
    for (std::size_t t = 0; t < piece.mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = piece.mesh.triangles[t];
      const auto& v = piece.mesh.vertices;
      const Vec3d across = cross(v[b] - v[a], v[c] - v[a]);
      if (length(across) > 1e-12) {
        for (const std::uint32_t corner : {a, b, c})
          EXPECT_NEAR(dot(piece.mesh.normals[corner], across) / length(across), 1, 1e-6) << "flat, and no bleeding";
      }
      if (piece.mesh.materials[t] == 2) continue;
      EXPECT_EQ(piece.mesh.materials[t], std::abs(piece.mesh.normals[a].x) > 0.5 ? 1 : 0);
      for (const std::uint32_t corner : {a, b, c}) {
        const Vec2d want = mapOf(v[corner] + piece.place);
        EXPECT_NEAR(piece.mesh.uvs[corner].x, want.x, 1e-12);
        EXPECT_NEAR(piece.mesh.uvs[corner].y, want.y, 1e-12);
      }
    }
  }
}

TEST(SolidFracture, TheNumberOfThreadsChangesNothing) {
  const TriangleMesh mesh = samples::dumbbell(6000);
  for (const auto& settings : {flatCells(20), rough(20), flattened(20)}) {
    const ThreadLimit one(1);
    const FracturedBody alone = fractureSolid(mesh, settings);
    const ThreadLimit four(4);
    const FracturedBody together = fractureSolid(mesh, settings);
    ASSERT_EQ(alone.pieces.size(), together.pieces.size());
    for (std::size_t p = 0; p < alone.pieces.size(); ++p) {
      EXPECT_EQ(alone.pieces[p].mesh, together.pieces[p].mesh);
      EXPECT_EQ(alone.pieces[p].place, together.pieces[p].place);
    }
  }
}

TEST(SolidFracture, SizeAndPlaceOfABodyDoNotMatter) {
  for (const double size : {1e-3, 1e4})
    for (const Vec3d& offset : {Vec3d(0, 0, 0), Vec3d(1e3, -2e4, 1e5)}) {
      SCOPED_TRACE(size);
      TriangleMesh mesh = samples::bumpySphere(720);
      for (Vec3d& v : mesh.vertices) v = v * size + offset;
      expectSolidPieces(mesh, flatCells(9));
      expectSolidPieces(mesh, rough(4));
    }
}

TEST(SolidFracture, CoplanarFacesOnALatticeAreCutLikeAnyOther) {
  const TriangleMesh box = solid_shapes::latticeBox(12, {1, 1, 1}), plate = solid_shapes::latticeBox(20, {1, 1, 1e-3});
  for (const auto& settings : {flatCells(16), rough(8), flattened(8)}) {
    expectSolidPieces(box, settings);
    expectSolidPieces(plate, settings);
  }
}

TEST(SolidFracture, BodiesThatOverlapAreCutOneByOne) {
  using namespace solid_shapes;
  const TriangleMesh box = boxMesh({1, 1, 1}, false);
  for (const TriangleMesh& mesh :
       {joined(box, shifted(box, {0.5, 0.3, 0.2})), joined(box, box), joined(box, shifted(box, {1, 0, 0})),
        joined(sphereMesh(1, 16, false), sphereMesh(0.5, 10, false))})
    for (const auto& settings : {flatCells(7), rough(5)}) expectSolidPieces(mesh, settings);
}

TEST(SolidFracture, OnePieceIsTheBodyItself) {
  const TriangleMesh mesh = solid_shapes::hollowBall();
  expectSolidPieces(mesh, flatCells(1));
  const FracturedBody body = fractureSolid(mesh, rough(1));
  EXPECT_EQ(body.pieces[0].mesh.triangles.size(), mesh.triangles.size());
  EXPECT_TRUE(body.bonds.empty());
}

TEST(SolidFracture, ABodyTurnedInsideOutIsTurnedBack) {
  const FracturedBody body = fractureSolid(solid_shapes::turnedInsideOut(boxMesh({1, 1, 1}, false)), flatCells(5));
  EXPECT_EQ(solid_checker::fault(body, 1), "");
}

TEST(SolidFracture, OpenMeshesAreRefused) {
  TriangleMesh open = boxMesh({1, 1, 1}, false);
  open.triangles.pop_back();
  EXPECT_THROW(fractureSolid(open, flatCells(3)), InputError);
  EXPECT_THROW(fractureSolid(TriangleMesh{}, flatCells(3)), InputError);
  EXPECT_THROW(fractureSolid(rectangleMesh(1, 1), flatCells(3)), InputError);
}

TEST(SolidFracture, ABodyWithANeckBreaksThere) {
  const FracturedBody body = fractureSolid(samples::dumbbell(4000), settingsOf(Curvature{}, 2));
  ASSERT_EQ(body.bonds.size(), 1u);
  // The neck has radius 0.18 between balls at -1.2 and 1.2, whose surfaces end near -0.2 and 0.4.
  EXPECT_LT(body.bonds[0].area, 4 * pi * 0.18 * 0.18);
  EXPECT_GT(body.bonds[0].place.x, -0.5);
  EXPECT_LT(body.bonds[0].place.x, 0.7);
}

TEST(SolidFracture, CellsCrowdTowardsAnImpact) {
  const Vec3d impact{1, 0, 0};
  const FracturedBody body = fractureSolid(samples::bumpySphere(2000), settingsOf(Voronoi{impact, 2}, 60));
  int near = 0, far = 0;
  for (const Piece& piece : body.pieces) {
    near += length(piece.place - impact) < 0.7;
    far += length(piece.place + impact) < 0.7;
  }
  EXPECT_GT(near, 3 * far);
}

TEST(SolidFracture, FacesMadeFlatHaveOnePlanePerBond) {
  const FracturedBody body = fractureSolid(samples::bumpySphere(2000), flattened(8));
  for (const Bond& bond : body.bonds) EXPECT_NEAR(length(bond.normal), 1, 1e-12);
  std::map<std::pair<int, int>, int> seen;
  for (const Bond& bond : body.bonds) ++seen[{bond.a, bond.b}];
  for (const auto& [pair, times] : seen) EXPECT_EQ(times, 1);
  // All vertices of an inside face lie on the planes of its piece's bonds.
  for (std::size_t p = 0; p < body.pieces.size(); ++p) {
    const Piece& piece = body.pieces[p];
    for (std::size_t t = 0; t < piece.mesh.triangles.size(); ++t) {
      if (piece.mesh.materialNames[piece.mesh.materials[t]] != "inside") continue;
      double nearest = 1e300;
      for (const Bond& bond : body.bonds) {
        if (bond.a != static_cast<int>(p) && bond.b != static_cast<int>(p)) continue;
        double off = 0;
        for (const std::uint32_t v : piece.mesh.triangles[t])
          off = std::max(off, std::abs(dot(piece.mesh.vertices[v] + piece.place - bond.place, bond.normal)));
        nearest = std::min(nearest, off);
      }
      EXPECT_LT(nearest, 1e-7);
    }
  }
}

TEST(SolidFracture, HullsOfPiecesAreConvexClosedAndHoldThem) {
  for (const Piece& piece : fractureSolid(samples::torus(2000), rough(12)).pieces) {
    const TriangleMesh hull = convexHull(piece.mesh.vertices);
    EXPECT_TRUE(isClosed(hull));
    EXPECT_GE(solid_checker::volumeOf(hull), piece.properties.volume);
    for (const auto& [a, b, c] : hull.triangles) {
      const auto& v = hull.vertices;
      // By volume: where many points lie in one plane, facets may be slivers whose normals say nothing.
      const Vec3d n = cross(v[b] - v[a], v[c] - v[a]);
      for (const Vec3d& p : piece.mesh.vertices) EXPECT_LT(dot(p - v[a], n), 1e-8);
    }
  }
}

}  // namespace
}  // namespace brisance
