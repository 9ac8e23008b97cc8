// The models of the scenes: sound surfaces in even triangles that break where the thesis' ones do (its Table 5.2).
#include "assets/models.h"

#include <gtest/gtest.h>

#include "fracture/fracture.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_report.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

struct Expected {
  const char* name;
  samples::Model (*model)();
  int smaller;  ///< triangles of the smaller part in the thesis
  Box3 seam;    ///< [m] where the middle of the cut lies
};

std::vector<Expected> all() {
  return {{"cow", samples::cowModel, 1884, {{0.75, 1.2, -0.1}, {1.0, 1.6, 0.1}}},
          {"teddy", samples::teddyModel, 708, {{-0.1, 0.8, -0.1}, {0.1, 1.0, 0.1}}},
          {"statue", samples::statueModel, 698, {{-0.1, 0.9, -0.1}, {0.1, 1.2, 0.1}}},
          {"pumpkin", samples::pumpkinModel, 4826, {{-0.15, 0.25, -0.15}, {0.15, 0.65, 0.15}}}};
}

std::filesystem::path fileOf(const char* name) {
  return std::filesystem::path(BRISANCE_SOURCE_DIR) / "assets" / "models" / (std::string(name) + ".obj");
}

FracturedBody halves(const TriangleMesh& mesh, CurvatureWeights weights) {
  FractureSettings settings;
  settings.method = Curvature{weights, 0, InsideParts::all};
  settings.pieces = 2;
  return fractureMesh(mesh, settings, 0.01);
}

/// The mean of the edges between triangles of two pieces, by their lengths.
Vec3d middleOfCut(const TriangleMesh& mesh, const std::vector<int>& pieceOf) {
  const std::vector<Triangle> across = edgeNeighbours(mesh);
  Vec3d sum;
  double total = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int edge = 0; edge < 3; ++edge) {
      if (pieceOf[t] == pieceOf[across[t][edge]]) continue;
      const Vec3d &a = mesh.vertices[mesh.triangles[t][edge]], &b = mesh.vertices[mesh.triangles[t][(edge + 1) % 3]];
      sum += (a + b) / 2.0 * length(a - b);
      total += length(a - b);
    }
  return sum / total;
}

TEST(Models, AreOneSoundSurfaceOfTheThesisNumberOfTriangles) {
  for (const Expected& expected : all()) {
    const TriangleMesh mesh = readMesh(fileOf(expected.name));
    const MeshReport report = examine(mesh);
    EXPECT_EQ(report.triangles, expected.model().triangles) << expected.name;
    EXPECT_TRUE(report.closed) << expected.name;
    EXPECT_EQ(report.pinched.count, 0u) << expected.name;
    EXPECT_EQ(report.parts, 1u) << expected.name;
    EXPECT_EQ(report.genus, 0) << expected.name;
    EXPECT_EQ(report.crossing.pairs, 0u) << expected.name;
    EXPECT_GT(report.volume, 0) << expected.name;
  }
}

/// Corners lie on the solid but for rounding to 1e-5 m in each coordinate: sqrt(3) / 2 of that, where the function
/// grows by at most 2 per metre.
TEST(Models, LieOnTheirSolids) {
  for (const Expected& expected : all()) {
    const samples::Model model = expected.model();
    double farthest = 0;
    for (const Vec3d& v : readMesh(fileOf(expected.name)).vertices)
      farthest = std::max(farthest, std::abs(model.solid(v)));
    EXPECT_LT(farthest, 2e-5) << expected.name;
  }
}

/// Edges between 4/5 and 4/3 of the wanted length, spread evenly, deviate by (4/3 - 4/5) / sqrt(12) = 0.154 of it.
TEST(Models, HaveEvenEdges) {
  for (const Expected& expected : all()) {
    const samples::EdgeSize size = edgeSizeOf(expected.model());
    EXPECT_LT(samples::edgeUnevenness(readMesh(fileOf(expected.name)), size), 0.154) << expected.name;
  }
}

TEST(Models, BreakInTwoAtTheSeamInTheThesisProportion) {
  for (const Expected& expected : all())
    for (const CurvatureWeights weights : {CurvatureWeights::raw, CurvatureWeights::clipped}) {
      const TriangleMesh mesh = readMesh(fileOf(expected.name));
      const FracturedBody body = halves(mesh, weights);
      ASSERT_EQ(body.pieces.size(), 2u);
      std::size_t smaller = mesh.triangles.size();
      for (const Piece& piece : body.pieces) {
        EXPECT_EQ(componentCount(piece.mesh), 1) << expected.name;
        smaller = std::min(smaller, piece.mesh.triangles.size());
      }
      EXPECT_NEAR(static_cast<double>(smaller), expected.smaller, 0.1 * expected.smaller) << expected.name;
      const Vec3d middle = middleOfCut(mesh, body.pieceOfTriangle);
      EXPECT_TRUE(expected.seam.contains(middle))
          << expected.name << ": " << middle.x << " " << middle.y << " " << middle.z;
    }
}

TEST(Models, AreWhatTheirProgramMakesBitForBit) {
  for (const Expected& expected : all()) {
    const samples::Model model = expected.model();
    const TriangleMesh made = meshOf(model, static_cast<long>(model.triangles));
    EXPECT_TRUE(made == readMesh(fileOf(expected.name))) << expected.name;
  }
}

}  // namespace
}  // namespace brisance
