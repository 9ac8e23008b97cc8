// Input files that are missing or damaged.
#include <gtest/gtest.h>

#include "faults/one_line.h"

namespace brisance::test {
namespace {

/// A scene with one body made of a mesh file and a texture.
struct MeshScene {
  MeshScene() {
    writeText(scene, smallSceneText(2) + R"(
[[bodies]]
name = "thing"
shape = { type = "mesh", file = "thing.obj" }
position = [0.5, 0.2, 0.5]
)");
    writeText(mesh, tetrahedron);
  }
  Outcome simulate() { return runProgram({"simulate", scene, "-o", run, "--quiet"}); }
  void expectRefusal(int exitCode, const std::vector<std::string>& words) {
    expectOneLine(simulate(), exitCode, words);
    EXPECT_FALSE(fs::exists(run)) << "nothing shall be made of a damaged input";
  }

  static constexpr const char* tetrahedron =
      "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  ScratchDirectory place;
  fs::path scene = place / "scene.toml", mesh = place / "thing.obj", run = place / "run";
};

TEST(InputFiles, AWholeMeshIsAccepted) {
  MeshScene s;
  const Outcome outcome = s.simulate();
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  expectInOrder(s.run);
}

TEST(InputFiles, AMissingMeshIsAMistakeOfTheScene) {
  MeshScene s;
  fs::remove(s.mesh);
  s.expectRefusal(2, {s.scene.string() + ":", "thing.obj"});
}

TEST(InputFiles, AnIndexBeyondTheVerticesIsNamedWithItsLine) {
  MeshScene s;
  writeText(s.mesh, std::string(MeshScene::tetrahedron) + "f 1 2 9\n");
  s.expectRefusal(3, {s.mesh.string() + ":9", "9"});
}

TEST(InputFiles, ANumberThatIsNotFiniteIsNamedWithItsLine) {
  MeshScene s;
  for (const std::string& number : std::vector<std::string>{"nan", "inf", "1e999", "zero"}) {
    writeText(s.mesh, "v 0 0 0\nv 0.1 0 " + number + "\nv 0 0.1 0\nf 1 2 3\n");
    s.expectRefusal(3, {s.mesh.string() + ":2"});
  }
}

TEST(InputFiles, AMeshOfNothingIsDamaged) {
  MeshScene s;
  writeText(s.mesh, "");
  s.expectRefusal(3, {s.mesh.string()});
}

TEST(InputFiles, ATextureThatIsNoPictureIsFoundBeforeTheSimulation) {
  MeshScene s;
  writeText(s.place / "wall.png", "not a picture");
  std::ofstream(s.scene, std::ios::app) << "\n[[materials]]\nname = \"wall\"\ntexture = \"wall.png\"\n";
  s.expectRefusal(3, {"wall.png"});
}

TEST(RunFiles, AChangedOrMissingFileIsNamedByVerify) {
  MeshScene s;
  ASSERT_EQ(s.simulate().exitCode, 0);
  const std::string gas = "gas/gas.0002.vdb", bodies = "bodies/bodies.0001.json";
  std::string bytes = textOf(s.run / gas);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  writeText(s.run / gas, bytes);
  expectOneLine(runProgram({"verify", s.run}), 3, {gas});
  fs::remove(s.run / bodies);
  const Outcome both = runProgram({"verify", s.run});
  EXPECT_EQ(both.exitCode, 3);
  EXPECT_NE(both.err.find(gas), std::string::npos) << both.err;
  EXPECT_NE(both.err.find(bodies), std::string::npos) << both.err;
}

TEST(RunFiles, APictureOfADamagedFrameIsRefused) {
  MeshScene s;
  ASSERT_EQ(s.simulate().exitCode, 0);
  const std::string particles = "particles/particles.0001.ply";
  std::string bytes = textOf(s.run / particles);
  bytes[bytes.size() - 1] = static_cast<char>(bytes[bytes.size() - 1] ^ 1);
  writeText(s.run / particles, bytes);
  expectOneLine(runProgram({"render", s.run, "--quiet"}), 3, {particles});
  EXPECT_FALSE(fs::exists(s.run / "images/frame.0001.png"));
}

TEST(RunFiles, ADamagedManifestIsNamed) {
  MeshScene s;
  ASSERT_EQ(s.simulate().exitCode, 0);
  writeText(s.run / "manifest.json", "{");
  expectOneLine(runProgram({"verify", s.run}), 3, {"manifest.json"});
  expectOneLine(runProgram({"render", s.run}), 3, {"manifest.json"});
}

TEST(RunFiles, ADamagedCheckpointIsNotTrusted) {
  MeshScene s;
  ASSERT_EQ(s.simulate().exitCode, 0);
  const fs::path checkpoint = s.run / "checkpoints/checkpoint.0002.bin";
  ASSERT_TRUE(fs::exists(checkpoint));
  std::string bytes = textOf(checkpoint);
  const std::string whole = bytes;
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  writeText(checkpoint, bytes);
  EXPECT_EQ(runProgram({"simulate", s.scene, "-o", s.run, "--resume", "--quiet"}).exitCode, 0);
  EXPECT_TRUE(textOf(checkpoint) == whole) << "made again from the start";
}

}  // namespace
}  // namespace brisance::test
