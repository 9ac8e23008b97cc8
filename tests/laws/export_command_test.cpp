// `brisance export`, as a script uses it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "faults/one_line.h"
#include "frame/exported_files.h"
#include "frame/gas_file.h"
#include "frame/point_file.h"
#include "frame/run_directory.h"
#include "mesh/mesh_file.h"
#include "program.h"

namespace brisance::test {
namespace {

using nlohmann::json;

constexpr int frames = 5;
constexpr double fps = 24;

/// One small run for all the tests.
class ExportCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = new ScratchDirectory();
    writeText(*shared_ / "small.toml", smallSceneText(frames));
    const Outcome made = runProgram({"simulate", *shared_ / "small.toml", "-o", run(), "--quiet"});
    ASSERT_EQ(made.exitCode, 0) << made.err;
  }
  static void TearDownTestSuite() { delete shared_; }

  static fs::path run() { return *shared_ / "run"; }
  std::string file(const std::string& name) const { return (directory_ / name).string(); }

  static std::vector<std::string> words(std::vector<std::string> options) {
    options.insert(options.begin(), {"export", run().string(), "--quiet"});
    return options;
  }
  static json facts(std::vector<std::string> options) {
    options.push_back("--json");
    const Outcome outcome = runProgram(words(std::move(options)));
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return json::parse(outcome.out);
  }
  static void expectRefusal(std::vector<std::string> options, int code, const std::vector<std::string>& said) {
    expectOneLine(runProgram(words(std::move(options))), code, said);
    expectInOrder(run());
  }

  static ScratchDirectory* shared_;
  ScratchDirectory directory_;
};
ScratchDirectory* ExportCommand::shared_ = nullptr;

TEST_F(ExportCommand, GltfHasEveryPieceInItsPlace) {
  const json told = facts({"--to", "gltf", "-o", file("film.glb")});
  EXPECT_EQ(told["bodies"]["count"], 6);
  EXPECT_EQ(told["frames"], json({{"first", 1}, {"last", frames}, {"count", frames}}));
  EXPECT_EQ(told["bytes"], fs::file_size(file("film.glb")));
  const Glb glb(textOf(file("film.glb")));
  EXPECT_EQ(glb.json["nodes"].size(), 6u);
  for (const int index : {1, 3, frames})
    for (const FrameBody& body : readFrame(run(), index, false).bodies) {
      const auto place = glb.at(body.name, "translation", (index - 1) / fps);
      for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(place.at(axis), body.pose.position[axis], 1e-6);
    }
  EXPECT_EQ(directory_.count(), 1u);
}

TEST_F(ExportCommand, ParticlesBecomeVdbPointsOfEveryFrame) {
  const json told = facts({"--to", "vdb-points", "-o", file("points"), "--frames", "2-4:2"});
  EXPECT_EQ(told["files"], 2);
  for (const int index : {2, 4}) {
    const std::string bytes = textOf(directory_ / ("points/particles.000" + std::to_string(index) + ".vdb"));
    const PointFileSettings settings{
        {1 / 32.0, 1 / 32.0, 1 / 32.0}, 1 / 16.0, {0.022f, 0.022f, 0.022f, 0.003f, 0.0025f}};
    EXPECT_EQ(bytes, particlesToVdb(readFrame(run(), index, false).particles, settings));
  }
  expectRefusal({"--to", "vdb-points", "-o", file("other"), "--profile", "blender"}, 2, {"--profile"});
}

TEST_F(ExportCommand, FramesMayBeChosen) {
  EXPECT_EQ(facts({"--to", "obj", "-o", file("obj"), "--frames", "1-5:2"})["frames"]["count"], 3);
  for (const char* name : {"bodies.0001.obj", "bodies.0003.obj", "bodies.0005.obj"})
    EXPECT_TRUE(fs::exists(directory_ / "obj" / name)) << name;
  const std::vector<FrameBody> bodies = readFrame(run(), 5, false).bodies;
  const TriangleMesh mesh = readObj(directory_ / "obj/bodies.0005.obj");
  const Vec3d first = bodies[0].pose * bodies[0].mesh->vertices[0];
  EXPECT_NEAR(length(mesh.vertices[0] - first), 0, 1e-12);
}

TEST_F(ExportCommand, GasIsCopiedByteForByte) {
  facts({"--to", "vdb", "-o", file("gas")});
  for (int index = 1; index <= frames; ++index) {
    const std::string name = "gas." + std::string("000") + std::to_string(index) + ".vdb";
    EXPECT_EQ(textOf(directory_ / "gas" / name), textOf(run() / "gas" / name));
  }
}

TEST_F(ExportCommand, ABlendersGasIsTurnedGas) {
  facts({"--to", "vdb", "-o", file("gas"), "--profile", "blender", "--frames", "5"});
  const FrameGas gas = readGas(run() / "gas/gas.0005.vdb");
  EXPECT_EQ(textOf(directory_ / "gas/gas.0005.vdb"), gasToVdb(gas, {"velocity", true}));
}

TEST_F(ExportCommand, UsdPointsFromWhereItLiesToTheRunsGas) {
  facts({"--to", "usd", "-o", file("film.usda")});
  const UsdPrim layer = UsdReader(textOf(file("film.usda"))).layer();
  EXPECT_EQ(layer.at("/World/Bodies")->children.size(), 6u);
  const auto& files = layer.at("/World/Gas/temperature")->timeSamples.at("asset filePath");
  ASSERT_EQ(files.size(), std::size_t(frames));
  for (const auto& [code, asset] : files) {
    const fs::path path = asset.substr(1, asset.size() - 2);
    EXPECT_TRUE(path.is_relative());
    EXPECT_TRUE(fs::equivalent(directory_ / path.string(), run() / ("gas/gas.000" + std::to_string(code) + ".vdb")));
  }
}

TEST_F(ExportCommand, WhatIsThereIsReplacedOnlyOnRequest) {
  for (const std::vector<std::string>& what :
       {std::vector<std::string>{"gltf", "film.glb"}, {"usd", "film.usda"}, {"vdb", "gas"}, {"obj", "obj"}}) {
    const std::vector<std::string> options{"--to", what[0], "-o", file(what[1]), "--frames", "2"};
    facts(options);
    expectRefusal(options, 2, {file(what[1]), "--overwrite"});
    std::vector<std::string> again = options;
    again.push_back("--overwrite");
    again[5] = "3";
    facts(again);
  }
  EXPECT_EQ(directory_.count(), 4u);
  EXPECT_FALSE(fs::exists(directory_ / "gas/gas.0002.vdb")) << "the old folder is gone";
  EXPECT_TRUE(fs::exists(directory_ / "gas/gas.0003.vdb"));
}

TEST_F(ExportCommand, AFolderWithOtherFilesIsNeverReplaced) {
  fs::create_directory(directory_ / "mine");
  writeText(directory_ / "mine/thesis.txt", "mine");
  expectRefusal({"--to", "vdb", "-o", file("mine"), "--overwrite"}, 2, {file("mine")});
  EXPECT_EQ(textOf(directory_ / "mine/thesis.txt"), "mine");
}

TEST_F(ExportCommand, TheRunsOwnFilesAreNotForOthers) {
  for (const char* name : {"gas", "", "images"})
    expectRefusal({"--to", "vdb", "-o", (run() / name).string(), "--overwrite"}, 2, {"belongs to the run"});
  expectRefusal({"--to", "gltf", "-o", (run() / "pieces.glb").string(), "--overwrite"}, 2, {"belongs to the run"});
}

TEST_F(ExportCommand, MistakesOfTheCommandLineAreNamed) {
  expectOneLine(runProgram({"export", file("none"), "--to", "gltf", "-o", file("a.glb")}), 2, {file("none")});
  expectRefusal({"--to", "gltf", "-o", file("a.glb"), "--frames", "3-6"}, 2, {"has no frame 6", "frames 1 to 5"});
  expectRefusal({"--to", "gltf", "-o", file("a.gltf")}, 2, {"a.gltf", ".glb"});
  expectRefusal({"--to", "usd", "-o", file("a.usd")}, 2, {".usda"});
  expectRefusal({"--to", "fbx", "-o", file("a.fbx")}, 2, {"--to"});
  expectRefusal({"--to", "gltf", "-o", file("a.glb"), "--profile", "blender"}, 2, {"--profile"});
  expectRefusal({"--to", "gltf", "-o", file("none/a.glb")}, 2, {file("none")});
  fs::create_directory(directory_ / "d.glb");
  expectRefusal({"--to", "gltf", "-o", file("d.glb"), "--overwrite"}, 2, {"directory"});
  writeText(directory_ / "plain", "");
  expectRefusal({"--to", "vdb", "-o", file("plain"), "--overwrite"}, 2, {"directory"});
}

TEST_F(ExportCommand, DamagedFilesOfTheRunAreFoundAndNothingIsLeft) {
  const fs::path copy = directory_ / "copy", out = directory_ / "out";
  fs::copy(run(), copy, fs::copy_options::recursive);
  fs::resize_file(copy / "gas/gas.0004.vdb", 100);
  fs::resize_file(copy / "bodies/bodies.0004.json", 100);
  expectOneLine(runProgram({"export", copy, "--to", "vdb", "-o", out, "--quiet"}), 3, {"gas.0004.vdb"});
  expectOneLine(runProgram({"export", copy, "--to", "gltf", "-o", file("a.glb"), "--quiet"}), 3, {"bodies.0004.json"});
  EXPECT_EQ(directory_.count(), 1u);
}

TEST_F(ExportCommand, APlaceThatMayNotBeWrittenIsNamed) {
  for (const std::vector<std::string>& what : {std::vector<std::string>{"gltf", "a.glb"}, {"vdb", "gas"}})
    expectRefusal({"--to", what[0], "-o", "/proc/" + what[1]}, 4, {"/proc/" + what[1]});
}

}  // namespace
}  // namespace brisance::test
