#include <gtest/gtest.h>

#include <fstream>

#include "base/durable_file.h"
#include "frame/exported_files.h"
#include "frame/gltf_export.h"
#include "frame/sample_motion.h"
#include "scratch_directory.h"

namespace brisance {
namespace {

using test::Glb;

constexpr double fps = 24;
/// What a 32-bit float leaves of numbers of a few metres, or of a turn.
constexpr double tolerance = 1e-6;

SurfaceLooks sampleLooks() {
  SurfaceLooks looks;
  looks["glass"].glass = true;
  looks["glass"].refractiveIndex = 1.52;
  looks["stone"].colour = {0.25f, 0.5f, 0.125f};
  looks["stone"].roughness = 0.5;
  return looks;
}

Glb sampleFilm() { return Glb(motionToGlb(sampleMotion(), fps, sampleLooks())); }

const nlohmann::json& materialNamed(const Glb& glb, const std::string& name) {
  for (const auto& material : glb.json.at("materials"))
    if (material.at("name") == name) return material;
  throw std::runtime_error("no material " + name);
}

TEST(GltfFilm, HasANodeForEveryBodyAndOneMeshForThoseThatShareIt) {
  const Glb glb = sampleFilm();
  ASSERT_EQ(glb.json["nodes"].size(), 3u);
  EXPECT_EQ(glb.json["scenes"][0]["nodes"], nlohmann::json({0, 1, 2}));
  EXPECT_EQ(glb.json["meshes"].size(), 2u);
  EXPECT_EQ(glb.json["nodes"][0]["mesh"], glb.json["nodes"][1]["mesh"]);
}

TEST(GltfFilm, PutsEveryBodyInItsPlaceInEveryFrame) {
  const Glb glb = sampleFilm();
  const auto bodies = sampleBodies();
  for (int n = 0; n < 3; ++n)
    for (int frame = 1; frame <= sampleFrames; ++frame) {
      const Pose pose = samplePose(n, frame);
      const auto place = glb.at(bodies[n].name, "translation", (frame - 1) / fps);
      for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(place.at(axis), pose.position[axis], tolerance);
      const auto turn = glb.at(bodies[n].name, "rotation", (frame - 1) / fps);
      EXPECT_LE(apart({turn.at(3), turn.at(0), turn.at(1), turn.at(2)}, pose.orientation), tolerance) << n << frame;
    }
}

TEST(GltfFilm, KeysOfABodyAtRestAreLeftOut) {
  const Glb glb = sampleFilm();
  EXPECT_EQ(glb.track("pane.001", "translation").seconds.size(), std::size_t(sampleFrames));
  EXPECT_TRUE(glb.track("floor", "translation").seconds.empty());
  EXPECT_TRUE(glb.track("floor", "rotation").seconds.empty());
  // The first frame, the last one at rest, and those after it.
  const auto late = glb.track("pane.002", "translation").seconds;
  ASSERT_EQ(late.size(), std::size_t(2 + sampleFrames - releaseFrame));
  EXPECT_EQ(late[0], 0);
  EXPECT_NEAR(late[1], (releaseFrame - 1) / fps, tolerance);
}

TEST(GltfFilm, BodiesThatMoveInTheSameFramesShareTheirTimes) {
  const Glb glb = sampleFilm();
  std::set<int> inputs;
  for (const auto& sampler : glb.json["animations"][0]["samplers"]) inputs.insert(sampler["input"].get<int>());
  EXPECT_EQ(glb.json["animations"][0]["samplers"].size(), 4u);
  EXPECT_EQ(inputs.size(), 2u);
  for (const int input : inputs) {
    const auto seconds = glb.floats(input);
    EXPECT_EQ(glb.json["accessors"][input]["min"][0].get<float>(), seconds.front()[0]);
    EXPECT_EQ(glb.json["accessors"][input]["max"][0].get<float>(), seconds.back()[0]);
    for (std::size_t n = 1; n < seconds.size(); ++n) EXPECT_GT(seconds[n][0], seconds[n - 1][0]);
    EXPECT_FALSE(glb.viewOf(input).contains("target"));
  }
}

TEST(GltfFilm, RotationsGoTheShortWayRound) {
  const auto turns = sampleFilm().track("pane.001", "rotation").values;
  for (std::size_t n = 0; n < turns.size(); ++n) {
    float norm = 0, cosine = 0;
    for (int c = 0; c < 4; ++c) {
      norm += turns[n][c] * turns[n][c];
      cosine += turns[n][c] * turns[n > 0 ? n - 1 : 0][c];
    }
    EXPECT_NEAR(norm, 1, tolerance);
    EXPECT_GE(cosine, 0);
  }
}

TEST(GltfFilm, ABodyThatOnlyTurnsHasNoTrackOfPlaces) {
  RunMotion motion = sampleMotion();
  for (Pose& pose : motion.bodies[0].poses) pose.position = {1, 2, 3};
  motion.bodies[0].body.pose.position = {1, 2, 3};
  const Glb glb(motionToGlb(motion, fps, {}));
  EXPECT_TRUE(glb.track("pane.001", "translation").seconds.empty());
  EXPECT_FALSE(glb.track("pane.001", "rotation").seconds.empty());
  EXPECT_EQ(glb.at("pane.001", "translation", 0.2), std::vector<double>({1, 2, 3}));
}

TEST(GltfFilm, ABodyThatSwellsHasAllItsShapes) {
  RunMotion motion = swellingMotion();
  const Glb glb(motionToGlb(motion, fps, {}));
  const nlohmann::json& mesh = glb.json["meshes"][glb.json["nodes"][0]["mesh"].get<int>()];
  EXPECT_NE(glb.json["nodes"][0]["mesh"], glb.json["nodes"][1]["mesh"]);  // the other body keeps its shape
  const nlohmann::json& primitive = mesh["primitives"][0];
  const auto first = glb.floats(primitive["attributes"]["POSITION"].get<int>());
  ASSERT_EQ(primitive["targets"].size(), 3u);
  const auto keys = glb.track("pane.001", "weights");  // three weights for each time, one after the other
  ASSERT_EQ(keys.values.size(), 3 * keys.seconds.size());
  const auto weightsIn = [&](int frame) {
    const double seconds = (frame - 1) / fps;
    std::size_t key = 0;  // the last one not after the frame, or the first
    while (key + 1 < keys.seconds.size() && keys.seconds[key + 1] < seconds + tolerance) ++key;
    const bool between = key + 1 < keys.seconds.size() && keys.seconds[key] < seconds - tolerance;
    for (std::size_t t = 0; between && t < 3; ++t)
      EXPECT_EQ(keys.values[3 * key + t], keys.values[3 * key + 3 + t]) << frame;
    return std::array{keys.values[3 * key][0], keys.values[3 * key + 1][0], keys.values[3 * key + 2][0]};
  };
  for (int frame = 1; frame <= sampleFrames; ++frame) {
    const auto weights = weightsIn(frame);
    const auto& expected = motion.bodies[0].shapes[frame - 1]->vertices;
    for (std::size_t v = 0; v < first.size(); ++v)
      for (int axis = 0; axis < 3; ++axis) {
        double place = first[v][axis];
        for (std::size_t t = 0; t < 3; ++t)
          place += weights.at(t) * glb.floats(primitive["targets"][t]["POSITION"].get<int>())[v][axis];
        EXPECT_NEAR(place, expected[v][axis], tolerance) << frame;
      }
  }
}

TEST(GltfFilm, NothingMovesInAFilmOfOneFrame) {
  RunMotion motion = sampleMotion();
  motion.frames = {3};
  for (BodyMotion& body : motion.bodies) body = {body.body, {3}, {body.poses[2]}};
  EXPECT_FALSE(Glb(motionToGlb(motion, fps, {})).json.contains("animations"));
}

TEST(GltfFilm, GlassIsAnExtensionThatTheFileSaysItUses) {
  const Glb glb = sampleFilm();
  const auto& glass = materialNamed(glb, "glass");
  EXPECT_EQ(glass["extensions"]["KHR_materials_transmission"]["transmissionFactor"], 1);
  EXPECT_EQ(glass["extensions"]["KHR_materials_ior"]["ior"], 1.52);
  EXPECT_EQ(glb.json["extensionsUsed"], nlohmann::json({"KHR_materials_ior", "KHR_materials_transmission"}));
  const auto& stone = materialNamed(glb, "stone");
  EXPECT_EQ(stone["pbrMetallicRoughness"]["baseColorFactor"], nlohmann::json({0.25, 0.5, 0.125, 1}));
  EXPECT_EQ(stone["pbrMetallicRoughness"]["roughnessFactor"], 0.5);
}

/// A part of a mesh that the scene has no material for looks as its body, under a name of its own.
TEST(GltfFilm, OutsideAndInsideAreMaterialsOfTheirOwn) {
  TriangleMesh mesh = sampleTetrahedron();
  mesh.materialNames = {"outside", "inside", "stone"};
  mesh.materials = {1, 0, 0, 2};
  RunMotion motion = sampleMotion();
  motion.bodies.resize(1);
  motion.bodies[0].body.mesh = std::make_shared<const TriangleMesh>(mesh);
  const Glb glb(motionToGlb(motion, fps, sampleLooks()));
  ASSERT_EQ(glb.json["meshes"][0]["primitives"].size(), 3u);
  EXPECT_EQ(glb.json["materials"].size(), 3u);
  for (const char* name : {"glass.outside", "glass.inside"})
    EXPECT_TRUE(materialNamed(glb, name).at("extensions").contains("KHR_materials_ior")) << name;
  EXPECT_FALSE(materialNamed(glb, "stone").contains("extensions"));
}

TEST(GltfFilm, APictureLiesInTheFileOnceByteForByte) {
  const ScratchDirectory scratch;
  const std::string picture = "\x89PNG not a whole one";  // 20 bytes and one: what follows must be aligned again
  std::ofstream(scratch / "wall.png") << picture;
  SurfaceLooks looks = sampleLooks();
  for (const char* name : {"glass", "stone"}) looks[name].picture = scratch / "wall.png";
  looks["stone"].emission = {3, 1.5f, 0};
  const Glb glb(motionToGlb(sampleMotion(), fps, looks));
  ASSERT_EQ(glb.json["images"].size(), 1u);
  EXPECT_EQ(glb.json["images"][0]["mimeType"], "image/png");
  const auto& view = glb.json["bufferViews"].at(glb.json["images"][0]["bufferView"].get<std::size_t>());
  EXPECT_EQ(glb.bytesOf(view), picture);
  const auto& stone = materialNamed(glb, "stone");
  EXPECT_EQ(stone["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
  EXPECT_EQ(stone["emissiveTexture"]["index"], 0);
  EXPECT_EQ(stone["emissiveFactor"], nlohmann::json({1, 0.5, 0}));
  EXPECT_EQ(stone["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"], 3);
  for (const auto& each : glb.json["bufferViews"]) EXPECT_EQ(each["byteOffset"].get<std::size_t>() % 4, 0u);
}

}  // namespace
}  // namespace brisance
