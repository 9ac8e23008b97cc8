// Blender as the judge of what is exported: it imports a film's bodies and gas, says where they are, and draws a frame.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "frame/run_directory.h"
#include "program.h"
#include "render/picture_file.h"

namespace brisance::test {
namespace {

using nlohmann::json;

constexpr char blender[] = "/usr/bin/blender";
constexpr int frames = 6, fps = 24;
constexpr int looked[] = {1, 3, frames};
constexpr double threshold = 400;  // [K]

/// Blender's z is up.
Vec3d inBlender(const Vec3d& p) { return {p.x, -p.z, p.y}; }
Vec3d vectorFrom(const json& numbers) { return {numbers.at(0), numbers.at(1), numbers.at(2)}; }

class Blender : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!fs::exists(blender)) return;
    place_ = new ScratchDirectory();
    const std::string run = path("run"), glb = path("film.glb"), gas = path("gas");
    writeText(path("small.toml"), smallSceneText(frames));
    done({"simulate", path("small.toml"), "-o", run, "--quiet"});
    done({"export", run, "--to", "gltf", "-o", glb, "--quiet"});
    done({"export", run, "--to", "vdb", "-o", gas, "--profile", "blender", "--quiet"});
    StartOptions options;
    options.binary = blender;
    options.environment = {{"HOME", place_->path().string()}};
    const std::string script = std::string(BRISANCE_SOURCE_DIR) + "/tests/world/open_in_blender.py";
    const Outcome outcome =
        runProgram({"--background", "--factory-startup", "--python-exit-code", "9", "--python", script, "--", glb, gas,
                    std::to_string(fps), "1,3,6", std::to_string(threshold), path("seen.json"), path("frame.png")},
                   options);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    seen_ = new json(json::parse(textOf(path("seen.json"))));
  }
  static void TearDownTestSuite() {
    delete seen_;
    delete place_;
  }
  void SetUp() override {
    if (!fs::exists(blender)) GTEST_SKIP() << "Blender is not installed (packaging/test.txt names it)";
    ASSERT_NE(seen_, nullptr);
  }

  static void seesEveryPieceInItsPlace();
  static void seesEveryPieceTurnedAsItIs();
  static void seesTheGasOfTheSameFrame();
  static void seesWhereTheGasIsHot();
  static void drawsAPictureOfMoreThanSky();

  static std::string path(const std::string& name) { return (*place_ / name).string(); }
  static void done(const std::vector<std::string>& words) {
    const Outcome outcome = runProgram(words);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  }
  static const json& seen(int frame) { return seen_->at("frames").at(std::to_string(frame)); }
  static Frame written(int frame) { return readFrame(path("run"), frame, true); }

  static ScratchDirectory* place_;
  static json* seen_;
};
ScratchDirectory* Blender::place_ = nullptr;
json* Blender::seen_ = nullptr;

void Blender::seesEveryPieceInItsPlace() {
  for (const int frame : looked) {
    const Frame expected = written(frame);
    ASSERT_EQ(seen(frame).at("bodies").size(), expected.bodies.size());
    for (const FrameBody& body : expected.bodies) {
      const Vec3d place = vectorFrom(seen(frame).at("bodies").at(body.name));
      EXPECT_LE(length(place - inBlender(body.pose.position)), 1e-4) << body.name << " in frame " << frame;
    }
  }
  EXPECT_GT(length(vectorFrom(seen(1).at("bodies").at("pane.001")) - vectorFrom(seen(6).at("bodies").at("pane.001"))),
            0.01)
      << "nothing moved, so nothing was shown";
}

void Blender::seesEveryPieceTurnedAsItIs() {
  for (const int frame : looked)
    for (const FrameBody& body : written(frame).bodies) {
      Box3 expected, found;
      for (const Vec3d& v : body.mesh->vertices) expected.include(inBlender(body.pose * v));
      for (const json& corner : seen(frame).at("corners").at(body.name)) found.include(vectorFrom(corner));
      EXPECT_LE(length(found.lower - expected.lower), 1e-4) << body.name << " in frame " << frame;
      EXPECT_LE(length(found.upper - expected.upper), 1e-4) << body.name << " in frame " << frame;
    }
}

void Blender::seesTheGasOfTheSameFrame() {
  for (const int frame : looked) {
    EXPECT_EQ(seen(frame).at("error"), "");
    EXPECT_EQ(seen(frame).at("file"), "gas.000" + std::to_string(frame) + ".vdb");
    EXPECT_EQ(seen(frame).at("grids"),
              json({{"density", "FLOAT"}, {"flame", "FLOAT"}, {"temperature", "FLOAT"}, {"velocity", "VECTOR_FLOAT"}}));
  }
}

/// A surface between hot and cold cells passes between their centres: no further out than one cell, and never inside.
void Blender::seesWhereTheGasIsHot() {
  const int frame = frames;
  const SparseGrid<float> temperature = written(frame).gas.temperature;
  Box3 hot;
  for (const auto& brick : temperature.bricks)
    for (int n = 0; n < 512; ++n) {
      const Vec3i cell = brick.corner + Vec3i(n % 8, n / 8 % 8, n / 64);
      if (brick.values[n] > threshold) hot.include(inBlender(temperature.origin + Vec3d(cell) * temperature.cellSize));
    }
  ASSERT_LE(hot.lower.x, hot.upper.x) << "nothing is hot";
  ASSERT_FALSE(seen(frame).at("surface").is_null());
  // Blender 3.4 moves the surfaces that it makes of volumes by half a voxel along each axis, as its pictures do.
  const Vec3d half = Vec3d(0.5, 0.5, 0.5) * temperature.cellSize;
  const Vec3d lower = vectorFrom(seen(frame).at("surface").at(0)) - half;
  const Vec3d upper = vectorFrom(seen(frame).at("surface").at(1)) - half;
  constexpr double rounding = 1e-6;  // Blender's meshes are of 32-bit floats
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(lower[axis], hot.lower[axis] + rounding);
    EXPECT_GE(lower[axis], hot.lower[axis] - temperature.cellSize - rounding);
    EXPECT_GE(upper[axis], hot.upper[axis] - rounding);
    EXPECT_LE(upper[axis], hot.upper[axis] + temperature.cellSize + rounding);
  }
}

void Blender::drawsAPictureOfMoreThanSky() {
  const Picture picture = decodePicture(textOf(path("frame.png")), "frame.png");
  ASSERT_EQ(picture.width, 240);
  constexpr int noise = 40;  // of the few samples
  std::size_t differ = 0;
  for (std::size_t n = 0; n < picture.rgb.size(); n += 3) differ += std::abs(picture.rgb[n] - picture.rgb[0]) > noise;
  EXPECT_GT(differ, picture.rgb.size() / 3 / 20);
}

/// One test, for Blender is started once for a process.
TEST_F(Blender, OpensAndDrawsAFilmAsItIs) {
  seesEveryPieceInItsPlace();
  seesEveryPieceTurnedAsItIs();
  seesTheGasOfTheSameFrame();
  seesWhereTheGasIsHot();
  drawsAPictureOfMoreThanSky();
}

}  // namespace
}  // namespace brisance::test
