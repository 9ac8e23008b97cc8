#include "render/layer_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/parallel.h"
#include "read_layers.h"
#include "render/cryptomatte.h"
#include "render/exposure.h"
#include "scratch_directory.h"
#include "small_pictures.h"

using namespace brisance;

namespace {

constexpr int size = 32;

ReadLayers readBack(const std::string& bytes) {
  const ScratchDirectory place;
  const std::string name = (place / "layers.exr").string();
  std::ofstream(name, std::ios::binary) << bytes;
  return readLayers(name);
}

/// A red wall 5 m before the camera, a moving card of glass before its left half, sky to the right.
DrawnPicture drawnScene(int threads = 0) {
  Frame frame;
  frame.bodies = {bodyOf("wall", rectangleMesh(2, 9), "red", {{-1, 0, 0}, {}}),
                  bodyOf("pane.001", boxMesh({0.5, 9, 0.01}), "glass", {{-1.2, 0, 1}, {}})};
  frame.bodies[1].linearVelocity = {0.6, 0.3, 0};
  RenderSettings settings = smallPicture();
  Material red = whitePaint();
  red.diffuse = SolidColour{{0.5f, 0.25f, 0.125f}};
  settings.materials = {{"red", red}, {"glass", clearGlass()}};
  settings.lights = {PointLight{{0, 0, 3}, {9, 9, 9}}};
  const PictureTime time{0, 1.0 / 24, 0.5};
  RenderScratch scratch;
  const ThreadLimit limit(threads);
  return drawPicture(frame, settings, RenderAssets(settings), time, scratch);
}

const ReadLayers& sceneFile() {
  static const ReadLayers file = readBack(encodeLayers(drawnScene()));
  return file;
}

constexpr int onWall = 13, onGlass = 3, onSky = 28, row = 15;

}  // namespace

TEST(LayerFile, HoldsTheLayersUnderTheirNames) {
  std::vector<std::string> names;
  for (const auto& [name, values] : sceneFile().channels) names.push_back(name);
  const std::vector<std::string> expected{"A",
                                          "B",
                                          "CryptoObject00.A",
                                          "CryptoObject00.B",
                                          "CryptoObject00.G",
                                          "CryptoObject00.R",
                                          "CryptoObject01.A",
                                          "CryptoObject01.B",
                                          "CryptoObject01.G",
                                          "CryptoObject01.R",
                                          "CryptoObject02.A",
                                          "CryptoObject02.B",
                                          "CryptoObject02.G",
                                          "CryptoObject02.R",
                                          "G",
                                          "N.X",
                                          "N.Y",
                                          "N.Z",
                                          "R",
                                          "albedo.B",
                                          "albedo.G",
                                          "albedo.R",
                                          "depth.Z",
                                          "motion.X",
                                          "motion.Y",
                                          "motion.Z",
                                          "variance.B",
                                          "variance.G",
                                          "variance.R",
                                          "volume.A",
                                          "volume.B",
                                          "volume.G",
                                          "volume.R"};
  EXPECT_EQ(names, expected);
}

TEST(LayerFile, DepthIsAlongTheViewAndNormalsFaceTheCamera) {
  const ReadLayers& file = sceneFile();
  EXPECT_NEAR(file.at("depth.Z", onWall, 2), 5, 1e-5);  // not the longer way of that ray
  EXPECT_NEAR(file.at("depth.Z", onGlass, row), 3.995, 1e-5);
  EXPECT_EQ(file.at("depth.Z", onSky, row), 1e10f);
  EXPECT_NEAR(file.at("N.Z", onWall, row), 1, 1e-3);
  EXPECT_EQ(file.at("N.Z", onSky, row), 0);
}

TEST(LayerFile, AlbedoIsSeenThroughGlass) {
  const ReadLayers& file = sceneFile();
  EXPECT_NEAR(file.at("albedo.R", onWall, row), 0.5, 1e-3);
  EXPECT_NEAR(file.at("albedo.B", onWall, row), 0.125, 1e-3);
  const double twoSurfaces = 0.96 * 0.96;  // of index 1.5, met nearly at right angles
  EXPECT_NEAR(file.at("albedo.R", onGlass, row), 0.5 * twoSurfaces, 5e-3);
  EXPECT_EQ(file.at("A", onWall, row), 1);
  EXPECT_EQ(file.at("A", onSky, row), 0);
}

TEST(LayerFile, BodiesMoveByPixelsRightAndUp) {
  const ReadLayers& file = sceneFile();
  const double pixelsPerMetre = size / (2 * std::tan(20 * pi / 180)) / 3.995, seconds = 0.5 / 24;
  EXPECT_NEAR(file.at("motion.X", onGlass, row), 0.6 * seconds * pixelsPerMetre, 1e-3);
  EXPECT_NEAR(file.at("motion.Y", onGlass, row), 0.3 * seconds * pixelsPerMetre, 1e-3);
  EXPECT_EQ(file.at("motion.X", onWall, row), 0);
}

// Examples of the specification.
TEST(Cryptomatte, HashesAndIdsAreThoseOfTheSpecification) {
  EXPECT_EQ(murmurHash3(""), 0u);
  EXPECT_EQ(murmurHash3("hello"), 0x248bfa47u);
  EXPECT_EQ(murmurHash3("hello, world"), 0x149bbb7fu);
  EXPECT_EQ(murmurHash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
  EXPECT_FLOAT_EQ(cryptomatteId("hello"), 6.0705627102400005616e-17f);
  EXPECT_FLOAT_EQ(cryptomatteId("cube"), -4.08461912519e+15f);
  EXPECT_FLOAT_EQ(cryptomatteId("sphere"), 2.79018604383e+15f);
}

TEST(LayerFile, CryptomatteNamesTheBodiesAndTheirCoverage) {
  const ReadLayers& file = sceneFile();
  std::string prefix;
  for (const auto& [key, text] : file.texts)
    if (key.ends_with("/name") && text == "CryptoObject") prefix = key.substr(0, key.size() - 4);
  ASSERT_TRUE(prefix.starts_with("cryptomatte/")) << prefix;
  EXPECT_EQ(file.texts.at(prefix + "hash"), "MurmurHash3_32");
  EXPECT_EQ(file.texts.at(prefix + "conversion"), "uint32_to_float32");
  const auto manifest = nlohmann::json::parse(file.texts.at(prefix + "manifest"));
  ASSERT_EQ(manifest.size(), 2);
  const auto id = [&](const std::string& name) {
    return std::bit_cast<float>(
        static_cast<std::uint32_t>(std::stoul(manifest.at(name).get<std::string>(), nullptr, 16)));
  };
  EXPECT_EQ(file.at("CryptoObject00.R", onGlass, row), id("pane.001"));
  EXPECT_EQ(file.at("CryptoObject00.R", onWall, row), id("wall"));
  EXPECT_NEAR(file.at("CryptoObject00.G", onWall, row), 1, 1e-6);
  EXPECT_EQ(file.at("CryptoObject00.G", onSky, row), 0);
  bool shared = false;  // at the glass' edge
  for (int x = 0; x < size; ++x)
    if (file.at("CryptoObject00.A", x, row) > 0) {
      shared = true;
      EXPECT_NEAR(file.at("CryptoObject00.G", x, row) + file.at("CryptoObject00.A", x, row), 1, 1e-6);
    }
  EXPECT_TRUE(shared);
}

TEST(LayerFile, IsTheSameForOneThreadAndFour) { EXPECT_EQ(encodeLayers(drawnScene(1)), encodeLayers(drawnScene(4))); }

TEST(LayerFile, WithoutLayersItIsThePictureAlone) {
  DrawnPicture picture = drawnScene();
  picture.layers = {};
  EXPECT_EQ(readBack(encodeLayers(picture)).channels.size(), 3);
}

// Samples even over 0 .. 1 have a variance of 1/12; their mean has that times the sum of the squared weights.
TEST(Exposure, MeasuresTheVarianceOfThePixelsMean) {
  RenderSettings settings = smallPicture();
  settings.samples = 4;
  const CameraRays rays(settings, {}, 1);
  const Follow chance = [](std::span<CameraRay> packet, std::span<Vec3f> light) {
    for (std::size_t n = 0; n < packet.size(); ++n) {
      const float x = NumberRun(packet[n].numbers.bits())();
      light[n] = Vec3f(x, 2 * x, 0);
    }
  };
  const Exposed exposed = expose(rays, size, size, chance, Noise::measured);
  double variance = 0, spread = 0, halves = 0, squares = 0;
  for (const Vec3f& pixel : exposed.variance.pixels) variance += pixel.x / (size * size);
  for (const Vec3f& pixel : exposed.mean.pixels) spread += (pixel.x - 0.5) * (pixel.x - 0.5) / (size * size);
  for (std::size_t p = 0; p < exposed.mean.pixels.size(); ++p)
    halves += std::pow(exposed.halves[0].pixels[p].x - exposed.halves[1].pixels[p].x, 2) / (4.0 * size * size);
  for (int s = 0; s < rays.perPixel(); ++s) squares += rays.weight(s) * rays.weight(s);
  const double noise = 5 * std::sqrt(2.0 / (size * size));  // of a variance from that many values
  EXPECT_NEAR(variance, squares / 12, squares / 12 * noise);
  EXPECT_NEAR(spread, squares / 12, squares / 12 * noise);
  EXPECT_NEAR(halves, squares / 12, squares / 12 * noise);
  EXPECT_EQ(exposed.mean, expose(rays, size, size, chance, Noise::ignored).mean);
}
