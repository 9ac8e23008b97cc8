#include "mesh/mesh_repair.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "assets/sample_meshes.h"
#include "base/check.h"
#include "fuzz/mesh_entry.h"
#include "mesh/mass_properties.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {

bool says(const RepairedMesh& repaired, const std::string& words) {
  return std::any_of(repaired.done.begin(), repaired.done.end(),
                     [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

TriangleMesh together(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({a + first, b + first, c + first});
  }
  return all;
}

TriangleMesh insideOut(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh box(double size, const Vec3d& at = {}) { return moved(boxMesh({size, size, size}, false), {at, {}}); }

void expectSolid(const RepairedMesh& repaired, double volume) {
  ASSERT_NO_THROW(requireSolid(repaired, "mesh.obj"));
  fuzz::checkManifold(bareSurface(repaired));
  EXPECT_NEAR(solidProperties(repaired.mesh).volume, volume, 1e-12 * (1 + volume));
  EXPECT_EQ(repaired.sourceTriangle.size(), repaired.mesh.triangles.size());
  EXPECT_EQ(repaired.surfaceVertexOf.size(), repaired.mesh.vertices.size());
}

/// The one line with which a mesh is refused as a solid.
std::string refusal(const RepairedMesh& repaired) {
  try {
    requireSolid(repaired, "mesh.obj");
  } catch (const DamagedFile& refused) {
    return refused.what();
  }
  return "";
}

TEST(MeshRepair, LeavesASoundMeshAsItIs) {
  for (const TriangleMesh& mesh : {samples::torus(2000), sphereMesh(1, 16, false), box(1)}) {
    const RepairedMesh repaired = repair(mesh);
    EXPECT_EQ(repaired.mesh, mesh);
    EXPECT_TRUE(repaired.done.empty()) << repaired.done.front();
    expectSolid(repaired, solidProperties(mesh).volume);
    EXPECT_TRUE(examine(mesh).isSound());
  }
}

TEST(MeshRepair, KeepsTextureSeamsOverAClosedSurface) {
  const TriangleMesh mesh = boxMesh({1, 2, 3});
  const RepairedMesh repaired = repair(mesh);
  EXPECT_EQ(repaired.mesh, mesh);
  EXPECT_EQ(repaired.surfaceVertices, 8u);
  expectSolid(repaired, 6);
}

TEST(MeshRepair, DropsTrianglesThatComeBackToACorner) {
  TriangleMesh mesh = cornerTetrahedron();
  mesh.triangles.insert(mesh.triangles.begin(), {1, 1, 2});
  const RepairedMesh repaired = repair(mesh);
  EXPECT_EQ(repaired.mesh, cornerTetrahedron());
  EXPECT_EQ(repaired.sourceTriangle, (std::vector<std::uint32_t>{1, 2, 3, 4}));
  EXPECT_TRUE(says(repaired, "triangles dropped that come back to a corner: 1, the first at"));
}

TEST(MeshRepair, LeavesOneOfEqualCopiesAndNoneOfOpposites) {
  TriangleMesh mesh = cornerTetrahedron();
  mesh.triangles.push_back({2, 1, 0});  // the first, begun elsewhere
  const RepairedMesh copied = repair(mesh);
  EXPECT_EQ(copied.mesh, cornerTetrahedron());
  EXPECT_TRUE(says(copied, "copies of triangles dropped: 1"));
  mesh = cornerTetrahedron();
  mesh.vertices.push_back({5, 5, 5});
  mesh.triangles.push_back({1, 2, 4});
  mesh.triangles.push_back({2, 1, 4});
  const RepairedMesh opposed = repair(mesh);
  EXPECT_EQ(opposed.mesh, cornerTetrahedron());
  EXPECT_TRUE(says(opposed, "triangles dropped that lie back to back: 2"));
}

TEST(MeshRepair, NamesAPartThatIsLost) {
  TriangleMesh mesh = together({box(1), cornerTetrahedron()});
  mesh.triangles.resize(12);
  mesh.triangles.push_back({8, 9, 10});
  mesh.triangles.push_back({8, 10, 9});
  const RepairedMesh repaired = repair(mesh);
  expectSolid(repaired, 1);
  EXPECT_TRUE(says(repaired, "parts lost, of which no triangle bounds anything: 1"));
  EXPECT_TRUE(says(repaired, "vertices left out that no triangle uses: 4"));
}

/// A corner on the edge between two triangles, held by a triangle of no area: dropped, the surface would open.
TEST(MeshRepair, GivesATriangleOfNoAreaToItsNeighbour) {
  for (const bool withUvs : {false, true}) {
    TriangleMesh mesh = cornerTetrahedron();
    mesh.vertices.push_back({0.25, 0, 0});
    mesh.triangles = {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 1, 4}, {0, 3, 2}, {1, 2, 3}};
    if (withUvs) mesh.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {9, 9}};
    EXPECT_EQ(examine(mesh).slivers.count, 1u);
    const RepairedMesh repaired = repair(mesh);
    expectSolid(repaired, 1.0 / 6);
    EXPECT_EQ(examine(repaired.mesh).slivers.count, 0u);
    EXPECT_EQ(repaired.mesh.triangles.size(), 6u);
    EXPECT_EQ(repaired.sourceTriangle, (std::vector<std::uint32_t>{0, 1, 2, 0, 4, 5}));
    EXPECT_TRUE(says(repaired, "triangles of no area given to their neighbours: 1"));
    if (withUvs) {
      EXPECT_EQ(repaired.mesh.uvs.back(), (Vec2d{0.25, 0}));  // of the neighbour's side
    }
  }
}

TEST(MeshRepair, WeldsWithinADistanceWhereAsked) {
  TriangleMesh mesh = box(1);
  std::vector<Vec3d> corners;
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) {
      corners.push_back(mesh.vertices[v] + Vec3d{1e-6 * static_cast<double>(corners.size() % 3), 0, 0});
      v = static_cast<std::uint32_t>(corners.size()) - 1;
    }
  mesh.vertices = corners;
  EXPECT_NE(refusal(repair(mesh)), "");
  const RepairedMesh repaired = repair(mesh, {1e-5, 0});
  ASSERT_NO_THROW(requireSolid(repaired, "mesh.obj"));
  EXPECT_EQ(repaired.surfaceVertices, 8u);
  EXPECT_NEAR(solidProperties(repaired.mesh).volume, 1, 1e-5);
  EXPECT_TRUE(says(repaired, "vertices moved to one within 1e-05 m"));
}

TEST(MeshRepair, TurnsTrianglesToAgreeAndPartsOutward) {
  TriangleMesh mesh = box(1);
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  EXPECT_EQ(examine(mesh).flippedEdges.count, 3u);
  const RepairedMesh agreed = repair(mesh);
  expectSolid(agreed, 1);
  EXPECT_TRUE(says(agreed, "triangles turned to agree with their neighbours: 1"));
  const TriangleMesh two = together({box(1), insideOut(box(1, {5, 0, 0}))});
  EXPECT_EQ(examine(two).insideOut.count, 1u);
  const RepairedMesh outward = repair(two);
  expectSolid(outward, 2);
  EXPECT_TRUE(says(outward, "parts turned outward: 1"));
}

TEST(MeshRepair, CavitiesFaceInwardHoweverDeepTheyNest) {
  for (const int turned : {0, 1, 2, 3, 4, 5, 6, 7}) {
    std::vector<TriangleMesh> shells;
    for (int depth = 0; depth < 3; ++depth)
      shells.push_back(turned >> depth & 1 ? insideOut(box(3 - depth)) : box(3 - depth));
    const RepairedMesh repaired = repair(together(shells));
    expectSolid(repaired, 27 - 8 + 1);
    EXPECT_EQ(repaired.done.empty(), turned == 2);  // the middle shell bounds the cavity
  }
}

TEST(MeshRepair, TakesApartAPinchedVertex) {
  const TriangleMesh mesh = welded(together({box(1), box(1, {1, 1, 1})}));
  EXPECT_EQ(examine(mesh).pinched.count, 1u);
  const RepairedMesh repaired = repair(mesh);
  expectSolid(repaired, 2);
  EXPECT_EQ(repaired.surfaceVertices, 16u);
  EXPECT_TRUE(
      says(repaired, "vertices taken apart where fans of triangles only touch: 1, the first at (0.5, 0.5, 0.5)"));
}

TEST(MeshRepair, TakesApartAnEdgeOfTwoBodies) {
  for (const bool turned : {false, true}) {
    const TriangleMesh second = box(1, {1, 1, 0});
    const TriangleMesh mesh = welded(together({box(1), turned ? insideOut(second) : second}));
    EXPECT_EQ(examine(mesh).tangledEdges.count, 1u);
    const RepairedMesh repaired = repair(mesh);
    expectSolid(repaired, 2);
    EXPECT_TRUE(says(repaired, "edges of several sheets taken apart: 1, the first at (0.5, 0.5, 0)"));
  }
}

TEST(MeshRepair, NamesTheFirstPlaceOfAnEdgeThatCannotBeToldApart) {
  TriangleMesh mesh = cornerTetrahedron();
  mesh.vertices.push_back({0.5, -1, -1});
  mesh.triangles.push_back({0, 1, 4});
  const std::string line = refusal(repair(mesh));
  EXPECT_TRUE(
      line.starts_with("mesh.obj: edges of several sheets that cannot be told apart: 1, the first at (0.5, 0, 0)"))
      << line;
}

TEST(MeshRepair, ClosesAHoleOnlyWhereAsked) {
  TriangleMesh mesh = box(1);
  mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4);  // one side
  EXPECT_EQ(examine(mesh).holes.count, 1u);
  EXPECT_TRUE(refusal(repair(mesh)).starts_with("mesh.obj: open edges: 4, the first at ("));
  EXPECT_NE(refusal(repair(mesh, {0, 3})), "");
  const RepairedMesh repaired = repair(mesh, {0, 4});
  expectSolid(repaired, 1);
  EXPECT_EQ(repaired.sourceTriangle.back(), noTriangle);
  EXPECT_TRUE(says(repaired, "holes closed: 1"));
}

TEST(MeshRepair, RefusesWhatBoundsNothing) {
  EXPECT_NE(refusal(repair(rectangleMesh(1, 1))), "");
  TriangleMesh one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  EXPECT_NE(refusal(repair(one)), "");
  one.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_TRUE(refusal(repair(one)).starts_with("mesh.obj: no triangle that bounds anything"));
}

/// A Moebius band has one side: six triangles around, turned over once.
TEST(MeshRepair, NamesWhereASurfaceHasButOneSide) {
  TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {0.5, 0.9, 0.2}, {-0.5, 0.9, 0}, {-1, 0, 0.2}, {-0.5, -0.9, 0}};
  for (std::uint32_t v = 0; v < 5; ++v) mesh.triangles.push_back({v, (v + 1) % 5, (v + 2) % 5});
  EXPECT_EQ(repair(mesh).twistedEdges.count, 1u);
}

TEST(MeshReport, CountsHandlesHolesAndParts) {
  const MeshReport torus = examine(samples::torus(2000));
  EXPECT_TRUE(torus.closed);
  EXPECT_EQ(torus.genus, 1);
  EXPECT_EQ(torus.euler, 0);
  const MeshReport sheet = examine(samples::foldedSheet(8, 60));
  EXPECT_FALSE(sheet.closed);
  EXPECT_EQ(sheet.holes.count, 1u);
  EXPECT_EQ(sheet.openEdges, 48u);
  const MeshReport two = examine(together({box(1), box(1, {3, 0, 0})}));
  EXPECT_EQ(two.parts, 2u);
  EXPECT_EQ(two.genus, 0);
  EXPECT_DOUBLE_EQ(two.volume, 2);
  EXPECT_DOUBLE_EQ(two.area, 12);
}

TEST(MeshReport, FindsWhereASurfaceCutsThroughItself) {
  EXPECT_EQ(examine(samples::dumbbell(4000)).crossing.pairs, 0u);
  EXPECT_EQ(examine(together({box(1), box(1, {1, 0, 0})})).crossing.pairs, 0u) << "touching is not cutting";
  const MeshReport crossed = examine(together({box(1), moved(box(1), {{0.31, 0.47, 0.23}, {}})}));
  EXPECT_GT(crossed.crossing.pairs, 0u);
  EXPECT_TRUE(crossed.crossing.all);
  EXPECT_FALSE(crossed.isSound());
}

/// The cow of the thesis' Table 5.2, which lies beside the project where its checks are made.
TEST(MeshReport, TheCowIsClosedWithOnePinchedVertex) {
  const char* folder = std::getenv("BRISANCE_MESHES");
  const std::filesystem::path beside = std::filesystem::path(BRISANCE_SOURCE_DIR) / "../shared/meshes";
  const std::filesystem::path cow = (folder ? std::filesystem::path(folder) : beside) / "cow.obj";
  if (!std::filesystem::exists(cow)) GTEST_SKIP() << cow << " is not here; BRISANCE_MESHES names its folder";
  const TriangleMesh mesh = readMesh(cow);
  const MeshReport report = examine(mesh);
  EXPECT_EQ(report.vertices, 2903u);
  EXPECT_EQ(report.triangles, 5804u);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.parts, 1u);
  EXPECT_EQ(report.pinched.count, 1u);
  EXPECT_EQ(report.genus, 0);
  const RepairedMesh repaired = repair(mesh);
  expectSolid(repaired, report.volume);
  EXPECT_EQ(repaired.surfaceVertices, 2904u);
}

}  // namespace
}  // namespace brisance
