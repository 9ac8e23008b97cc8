#include "frame/usd_export.h"

#include <gtest/gtest.h>

#include <set>

#include "frame/exported_files.h"
#include "frame/sample_motion.h"
#include "frame/usd_text.h"

namespace brisance {
namespace {

using test::numbersIn;
using test::UsdPrim;

UsdSettings sampleSettings() {
  UsdSettings settings;
  settings.fps = 30;
  settings.looks["glass"].glass = true;
  settings.looks["stone"].colour = {0.25f, 0.5f, 0.125f};
  settings.looks["stone"].picture = "../run/inputs/wall.png";
  settings.looks["stone"].emission = {2, 2, 2};
  for (int frame = 1; frame <= sampleFrames; ++frame)
    settings.gas.push_back({frame, fmt::format("../run/gas/gas.{:04}.vdb", frame)});
  settings.gasBox = {{-1, 0, -1}, {1, 2, 1}};
  return settings;
}

UsdPrim layerOf(const RunMotion& motion, const UsdSettings& settings = sampleSettings()) {
  return test::UsdReader(motionToUsda(motion, settings)).layer();
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Linear between the keys at hand, the nearest one outside.
std::vector<double> valueAt(const UsdPrim& prim, const std::string& property, int frame) {
  if (!prim.timeSamples.contains(property)) return numbersIn(prim.properties.at(property));
  const auto& samples = prim.timeSamples.at(property);
  const auto next = samples.lower_bound(frame);
  if (next == samples.end()) return numbersIn(samples.rbegin()->second);
  if (next->first == frame || next == samples.begin()) return numbersIn(next->second);
  const auto before = std::prev(next);
  std::vector<double> value = numbersIn(before->second);
  const std::vector<double> after = numbersIn(next->second);
  for (std::size_t n = 0; n < value.size(); ++n)
    value[n] += (after[n] - value[n]) * (frame - before->first) / (next->first - before->first);
  return value;
}

TEST(UsdFilm, SaysItsUnitsItsAxisAndItsTime) {
  const UsdPrim layer = layerOf(sampleMotion());
  for (const char* line : {"upAxis = \"Y\"", "metersPerUnit = 1\n", "timeCodesPerSecond = 30", "startTimeCode = 1\n",
                           "endTimeCode = 12\n", "defaultPrim = \"World\""})
    EXPECT_TRUE(contains(layer.metadata, line)) << line;
}

TEST(UsdFilm, PutsEveryBodyInItsPlaceInEveryFrame) {
  const UsdPrim layer = layerOf(sampleMotion());
  const char* names[] = {"pane_001", "pane_002", "floor"};
  for (int n = 0; n < 3; ++n) {
    const UsdPrim& body = *layer.at(std::string("/World/Bodies/") + names[n]);
    EXPECT_EQ(body.type, "Xform");
    EXPECT_EQ(body.properties.at("uniform token[] xformOpOrder"), "[\"xformOp:translate\", \"xformOp:orient\"]");
    for (int frame = 1; frame <= sampleFrames; ++frame) {
      const Pose pose = samplePose(n, frame);
      const auto place = valueAt(body, "double3 xformOp:translate", frame);
      for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(place.at(axis), pose.position[axis], 1e-12);
      const auto turn = valueAt(body, "quatf xformOp:orient", frame);
      EXPECT_LE(apart({turn.at(0), turn.at(1), turn.at(2), turn.at(3)}, pose.orientation), 1e-6);
    }
  }
}

TEST(UsdFilm, KeysOfABodyAtRestAreLeftOut) {
  const UsdPrim layer = layerOf(sampleMotion());
  EXPECT_TRUE(layer.at("/World/Bodies/floor")->timeSamples.empty());
  EXPECT_EQ(layer.at("/World/Bodies/pane_001")->timeSamples.at("double3 xformOp:translate").size(),
            std::size_t(sampleFrames));
  const auto& late = layer.at("/World/Bodies/pane_002")->timeSamples.at("double3 xformOp:translate");
  EXPECT_EQ(late.size(), std::size_t(2 + sampleFrames - releaseFrame));
  EXPECT_TRUE(late.contains(releaseFrame));
}

TEST(UsdFilm, ABodyThatSwellsHasItsPointsAtEveryChange) {
  const RunMotion motion = swellingMotion();
  const UsdPrim layer = layerOf(motion);
  const UsdPrim& mesh = *layer.at("/World/Bodies/pane_001/mesh");
  const auto& samples = mesh.timeSamples.at("point3f[] points");
  ASSERT_EQ(samples.size(), 4u);
  for (const auto& [frame, text] : samples) {
    const std::vector<double> numbers = numbersIn(text);
    const auto& expected = motion.bodies[0].shapes.at(static_cast<std::size_t>(frame) - 1)->vertices;
    ASSERT_EQ(numbers.size(), 3 * expected.size());
    for (std::size_t n = 0; n < numbers.size(); ++n)
      EXPECT_NEAR(numbers[n], expected[n / 3][static_cast<int>(n % 3)], 1e-5) << frame;
  }
  EXPECT_TRUE(samples.contains(4) && samples.contains(5) && samples.contains(9));
  EXPECT_FALSE(mesh.properties.contains("point3f[] points"));
}

TEST(UsdFilm, MeshesAreWhole) {
  const UsdPrim layer = layerOf(sampleMotion());
  const TriangleMesh expected = sampleTetrahedron();
  const UsdPrim& mesh = *layer.at("/World/Bodies/pane_001/mesh");
  EXPECT_EQ(mesh.properties.at("int[] faceVertexCounts"), "[3, 3, 3, 3]");
  EXPECT_EQ(numbersIn(mesh.properties.at("int[] faceVertexIndices")),
            std::vector<double>({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}));
  const auto points = numbersIn(mesh.properties.at("point3f[] points"));
  const auto normals = numbersIn(mesh.properties.at("normal3f[] normals"));
  const auto st = numbersIn(mesh.properties.at("texCoord2f[] primvars:st"));
  for (std::size_t v = 0; v < expected.vertices.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(points.at(3 * v + axis), expected.vertices[v][axis]);
      EXPECT_EQ(normals.at(3 * v + axis), expected.normals[v][axis]);
    }
    EXPECT_EQ(st.at(2 * v), expected.uvs[v].x);
    EXPECT_EQ(st.at(2 * v + 1), expected.uvs[v].y);
  }
  EXPECT_EQ(numbersIn(mesh.properties.at("float3[] extent")), std::vector<double>({0, 0, 0, 1, 1, 1.5}));
  EXPECT_EQ(mesh.properties.at("uniform token subdivisionScheme"), "\"none\"");
}

TEST(UsdFilm, SubsetsPartTheFacesAndEveryBindingLeadsToAMaterial) {
  const UsdPrim layer = layerOf(sampleMotion());
  const UsdPrim& mesh = *layer.at("/World/Bodies/floor/mesh");
  std::multiset<double> faces;
  for (const UsdPrim& subset : mesh.children) {
    EXPECT_EQ(subset.type, "GeomSubset");
    EXPECT_EQ(subset.properties.at("uniform token familyName"), "\"materialBind\"");
    for (const double face : numbersIn(subset.properties.at("int[] indices"))) faces.insert(face);
  }
  EXPECT_EQ(faces, std::multiset<double>({0, 1, 2, 3}));
  const std::function<void(const UsdPrim&)> check = [&](const UsdPrim& prim) {
    if (prim.properties.contains("rel material:binding")) {
      const std::string path = prim.properties.at("rel material:binding");
      const UsdPrim* material = layer.at(path.substr(1, path.size() - 2));
      ASSERT_NE(material, nullptr) << path;
      EXPECT_EQ(material->type, "Material");
    }
    for (const UsdPrim& child : prim.children) check(child);
  };
  check(layer);
}

TEST(UsdFilm, MaterialsArePreviewSurfaces) {
  const UsdPrim layer = layerOf(sampleMotion());
  const UsdPrim& glass = layer.at("/World/Materials/glass")->child("surface");
  EXPECT_EQ(glass.properties.at("uniform token info:id"), "\"UsdPreviewSurface\"");
  EXPECT_EQ(glass.properties.at("float inputs:ior"), "1.5");
  const UsdPrim& stone = *layer.at("/World/Materials/stone");
  EXPECT_EQ(stone.child("surface").properties.at("color3f inputs:diffuseColor.connect"),
            "</World/Materials/stone/diffuse.outputs:rgb>");
  EXPECT_EQ(stone.child("diffuse").properties.at("asset inputs:file"), "@../run/inputs/wall.png@");
  EXPECT_EQ(stone.child("glow").properties.at("float4 inputs:scale"), "(2, 2, 2, 1)");
}

TEST(UsdFilm, TheGasIsAFilePerFrameForEachField) {
  const UsdPrim layer = layerOf(sampleMotion());
  const UsdPrim& gas = *layer.at("/World/Gas");
  EXPECT_EQ(gas.type, "Volume");
  EXPECT_EQ(numbersIn(gas.properties.at("float3[] extent")), std::vector<double>({-1, 0, -1, 1, 2, 1}));
  for (const std::string& field : std::vector<std::string>{"density", "temperature", "flame", "vel"}) {
    EXPECT_EQ(gas.properties.at("rel field:" + field), "</World/Gas/" + field + ">");
    const UsdPrim& asset = gas.child(field);
    EXPECT_EQ(asset.type, "OpenVDBAsset");
    EXPECT_EQ(asset.properties.at("token fieldName"), "\"" + field + "\"");
    EXPECT_EQ(asset.timeSamples.at("asset filePath").size(), std::size_t(sampleFrames));
    EXPECT_EQ(asset.timeSamples.at("asset filePath").at(3), "@../run/gas/gas.0003.vdb@");
  }
}

TEST(UsdNames, AreLegalAndGivenOutOnce) {
  usd::Names names;
  EXPECT_EQ(names.unique("pane.007"), "pane_007");
  EXPECT_EQ(names.unique("pane_007"), "pane_007_2");
  EXPECT_EQ(names.unique("pane 007"), "pane_007_3");
  EXPECT_EQ(names.unique("7th"), "_7th");
  EXPECT_EQ(names.unique(""), "_");
}

TEST(UsdFilm, KeepsAForeignNameInItsMetadata) {
  RunMotion motion = sampleMotion();
  motion.bodies[0].body.name = "the \"old\" pane\\7\n";
  const UsdPrim layer = layerOf(motion);
  EXPECT_TRUE(contains(layer.at("/World/Bodies")->children[0].metadata, R"(string name = "the \"old\" pane\\7\x0a")"));
}

TEST(UsdText, APathWithItsOwnMarkIsMarkedThrice) {
  EXPECT_EQ(usd::asset("./a/b.vdb"), "@./a/b.vdb@");
  EXPECT_EQ(usd::asset("./a@b.vdb"), "@@@./a@b.vdb@@@");
}

}  // namespace
}  // namespace brisance
