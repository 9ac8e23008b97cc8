// `brisance fracture`, as a script uses it.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "assets/sample_meshes.h"
#include "faults/one_line.h"
#include "frame/gltf_export.h"
#include "mesh/mass_properties.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_topology.h"
#include "program.h"

namespace brisance::test {
namespace {

using nlohmann::json;

class FractureCommand : public ::testing::Test {
 protected:
  FractureCommand() { writeObj(mesh_, samples::dumbbell(3000)); }
  json facts(std::vector<std::string> options) const {
    options.insert(options.begin(), {"fracture", mesh_.string(), "--json"});
    const Outcome outcome = runProgram(options);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return json::parse(outcome.out);
  }
  std::string file(const std::string& name) const { return (directory_ / name).string(); }

  ScratchDirectory directory_;
  fs::path mesh_ = directory_ / "dumbbell.obj";
};

std::vector<int> labelsIn(const fs::path& file) {
  std::istringstream text(textOf(file));
  std::vector<int> labels;
  for (int label = 0; text >> label;) labels.push_back(label);
  return labels;
}

TEST_F(FractureCommand, TellsScriptsOfEveryPiece) {
  const json told = facts({"--pieces", "5"});
  const TriangleMesh mesh = readObj(mesh_);
  EXPECT_EQ(told["input"]["triangles"], mesh.triangles.size());
  EXPECT_EQ(told["input"]["vertices"], mesh.vertices.size());
  EXPECT_EQ(told["input"]["closed"], true);
  EXPECT_EQ(told["method"], "breadth_first");
  ASSERT_EQ(told["pieces"].size(), 5u);
  std::size_t triangles = 0;
  for (const json& piece : told["pieces"]) {
    EXPECT_EQ(piece["connected"], true);
    EXPECT_EQ(piece["closed"], false);
    EXPECT_GT(piece["neighbours"].size(), 0u);
    triangles += piece["triangles"].get<std::size_t>();
  }
  EXPECT_EQ(triangles, mesh.triangles.size());
  EXPECT_GT(told["cut"]["edges"], 0);
  for (const char* stage : {"read", "graph", "partition", "write"})
    EXPECT_TRUE(told["seconds"].contains(stage)) << stage;
  EXPECT_GT(told["peak_memory_mb"], 1.0);
}

TEST_F(FractureCommand, LabelsEveryInputTriangle) {
  facts({"--pieces", "7", "--labels", file("labels.txt")});
  const std::vector<int> labels = labelsIn(file("labels.txt"));
  EXPECT_EQ(labels.size(), readObj(mesh_).triangles.size());
  EXPECT_EQ(std::set<int>(labels.begin(), labels.end()), std::set<int>({0, 1, 2, 3, 4, 5, 6}));
}

TEST_F(FractureCommand, GivesTheSameLabelsWithOneThreadAndTwo) {
  for (const std::string& threads : std::vector<std::string>{"1", "2"})
    facts({"--pieces", "40", "--threads", threads, "--labels", file("labels" + threads)});
  EXPECT_EQ(textOf(file("labels1")), textOf(file("labels2")));
}

TEST_F(FractureCommand, WritesPiecesAsNamedNodesInPlace) {
  facts({"--pieces", "6", "-o", file("pieces.glb")});
  const std::vector<FrameBody> pieces = piecesFromGlb(textOf(file("pieces.glb")), "pieces.glb");
  ASSERT_EQ(pieces.size(), 6u);
  EXPECT_EQ(pieces[0].name, "dumbbell.001");
  std::set<std::array<float, 3>> places;
  std::size_t triangles = 0;
  for (const FrameBody& piece : pieces) {
    triangles += piece.mesh->triangles.size();
    for (const Vec3d& v : piece.mesh->vertices) {
      const Vec3f place(piece.pose * v);
      places.insert({place.x, place.y, place.z});
    }
  }
  const TriangleMesh mesh = readObj(mesh_);
  EXPECT_EQ(triangles, mesh.triangles.size());
  // Corners that pieces share are at one place again: as many places as the mesh has vertices.
  EXPECT_EQ(places.size(), mesh.vertices.size());
  EXPECT_TRUE(fs::exists(file("pieces.png")));
}

TEST_F(FractureCommand, WritesPiecesAsObjThatReadsBackWhole) {
  facts({"--pieces", "6", "-o", file("pieces.obj")});
  const TriangleMesh pieces = readObj(file("pieces.obj")), mesh = readObj(mesh_);
  EXPECT_EQ(pieces.triangles.size(), mesh.triangles.size());
  EXPECT_TRUE(isClosed(welded(pieces)));
}

TEST_F(FractureCommand, RefusesInOneLine) {
  const std::string mesh = mesh_.string();
  const auto refused = [](const std::vector<std::string>& options, int exitCode,
                          const std::vector<std::string>& words) {
    std::vector<std::string> arguments{"fracture"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expectOneLine(runProgram(arguments), exitCode, words);
  };
  refused({mesh, "--method", "magic"}, 2, {"--method", "breadth_first", "magic"});
  refused({mesh, "--weights", "raw"}, 2, {"--weights", "curvature", "breadth_first"});
  refused({mesh, "--method", "voronoi", "--impact", "1,2"}, 2, {"--impact", "X,Y,Z"});
  refused({mesh, "--pieces", "0"}, 2, {"--pieces"});
  refused({mesh, "--pieces", "1000000"}, 2, {"pieces", "1000000"});
  refused({mesh, "--flat"}, 2, {"--flat", "--solid"});
  refused({mesh, "-o", file("pieces.fbx")}, 2, {"pieces.fbx", ".glb"});
  refused({mesh, "-o", mesh}, 2, {mesh, "--overwrite"});
  refused({mesh, "-o", file("nowhere/pieces.glb")}, 2, {"nowhere"});
  refused({file("none.obj")}, 2, {"none.obj", "does not exist"});
  refused({mesh, "--set", "scene.seed=2"}, 2, {"--set", "scene"});
}

TEST_F(FractureCommand, BreaksTheBodiesOfASceneAsItSays) {
  writeText(directory_ / "scene.toml",
            "[[bodies]]\nname = \"pane\"\nshape = { type = \"pane\", points = 50 }\n"
            "fracture = { pieces = 9 }\n");
  const Outcome outcome = runProgram({"fracture", file("scene.toml"), "--json", "-o", file("scene.glb")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const json told = json::parse(outcome.out);
  ASSERT_EQ(told["bodies"].size(), 1u);
  EXPECT_EQ(told["bodies"][0]["name"], "pane");
  EXPECT_EQ(told["bodies"][0]["pieces"].size(), 9u);
  for (const json& piece : told["bodies"][0]["pieces"]) EXPECT_EQ(piece["closed"], true);
  EXPECT_EQ(piecesFromGlb(textOf(file("scene.glb")), "scene.glb").size(), 9u);
  expectOneLine(runProgram({"fracture", file("scene.toml"), "--pieces", "3"}), 2, {"--set"});
}

TEST_F(FractureCommand, ScenesTakeNoMeshThatPointsToOtherFiles) {
  writeText(directory_ / "house.gltf", "{}");
  writeText(directory_ / "scene.toml",
            "[[bodies]]\nname = \"a\"\nshape = { type = \"mesh\", file = \"house.gltf\" }\n");
  expectOneLine(runProgram({"fracture", file("scene.toml")}), 2, {"scene.toml:3", ".glb", "other files"});
}

TEST_F(FractureCommand, MakesSolidPiecesByEveryMethodAndSharesTheirInsideFaces) {
  const double whole = solidProperties(readObj(mesh_)).volume;
  const std::vector<std::vector<std::string>> methods{
      {"voronoi"},  {"breadth_first"},           {"curvature"},
      {"spectral"}, {"breadth_first", "--flat"}, {"voronoi", "--impact", "1,0,0.5"}};
  for (std::vector<std::string> method : methods) {
    method.insert(method.begin(),
                  {"--solid", "--pieces", "9", "--no-picture", "--overwrite", "-o", file("solid.glb"), "--method"});
    const json told = facts(method);
    ASSERT_EQ(told["pieces"].size(), 9u) << method[8];
    double volume = 0;
    for (const json& piece : told["pieces"]) {
      EXPECT_EQ(piece["closed"], true) << method[8];
      EXPECT_EQ(piece["connected"], true) << method[8];
      EXPECT_GT(piece["volume"], 0.0) << method[8];
      volume += piece["volume"].get<double>();
    }
    EXPECT_NEAR(volume, whole, 1e-6 * whole) << method[8];
    // Every inside triangle is there again, reversed, at exactly the same place of the file.
    std::map<std::array<Vec3f, 3>, int, bool (*)(const std::array<Vec3f, 3>&, const std::array<Vec3f, 3>&)> faces(
        [](const auto& a, const auto& b) {
          const auto flat = [](const auto& t) {
            return std::array{t[0].x, t[0].y, t[0].z, t[1].x, t[1].y, t[1].z, t[2].x, t[2].y, t[2].z};
          };
          return flat(a) < flat(b);
        });
    for (const FrameBody& piece : piecesFromGlb(textOf(file("solid.glb")), "solid.glb"))
      for (std::size_t t = 0; t < piece.mesh->triangles.size(); ++t) {
        if (piece.mesh->materialNames.at(piece.mesh->materials.at(t)) != "inside") continue;
        std::array<Vec3f, 3> corners;
        for (int c = 0; c < 3; ++c) corners[c] = Vec3f(piece.pose * piece.mesh->vertices[piece.mesh->triangles[t][c]]);
        const auto lowest = [](const Vec3f& a, const Vec3f& b) {
          return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        };
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), lowest), corners.end());
        const bool turned = lowest(corners[2], corners[1]);
        if (turned) std::swap(corners[1], corners[2]);
        faces[corners] += turned ? -1 : 1;
      }
    EXPECT_GT(faces.size(), 8u);
    for (const auto& [corners, sum] : faces) ASSERT_EQ(sum, 0) << method[8];
  }
}

}  // namespace
}  // namespace brisance::test
