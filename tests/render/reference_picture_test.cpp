// A picture against a stored one with its variance: BRISANCE_WRITE_REFERENCE=1 makes the stored one anew.
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/durable_file.h"
#include "base/random.h"
#include "render/picture_file.h"
#include "small_pictures.h"

using namespace brisance;

namespace {

/// The mean of independent pictures, and the deviation of that mean.
struct Measured {
  Image mean, deviation;
};

/// Fire and a lamp in an open box, with glass, brushed metal and wood.
std::pair<Frame, RenderSettings> everything() {
  Frame frame;
  frame.bodies = {bodyOf("floor", boxMesh({4, 0.1, 4}), "wood", {{0, -1.05, 0}, {}}),
                  bodyOf("wall", boxMesh({4, 3, 0.1}), "white", {{0, 0.4, -1.6}, {}}),
                  bodyOf("lamp", boxMesh({0.8, 0.1, 0.8}), "lamp", {{-1, 1.4, 0}, {}}),
                  bodyOf("pane", boxMesh({0.8, 1, 0.1}), "glass", {{0.9, -0.5, 0.6}, axisAngle({0, 1, 0}, 0.4)}),
                  bodyOf("ball", sphereMesh(0.4, 24), "metal", {{-0.9, -0.6, 0.4}, {}})};
  const Random random(1, Stream::test);
  for (int p = 0; p < 300; ++p) {
    frame.particles.position.push_back(Vec3f(random.normal3(p) * 0.25));
    frame.particles.velocity.push_back({});
    frame.particles.mass.push_back(0.001f);
    frame.particles.temperature.push_back(static_cast<float>(1500 + 700 * random.uniform(9000 + p)));
    frame.particles.kind.push_back(static_cast<std::uint8_t>(1 + p % 2));
  }
  RenderSettings settings = smallPicture(4.5);
  settings.width = 24;
  settings.height = 18;
  settings.background = {0.1f, 0.15f, 0.25f};
  Material wood = whitePaint(), metal = whitePaint();
  wood.diffuse = Wood{};
  metal.lighting = AshikhminLighting{20, 5};
  metal.diffuse = SolidColour{{0.1f, 0.1f, 0.1f}};
  metal.specular = {0.7f, 0.6f, 0.5f};
  settings.materials = {
      {"white", whitePaint()}, {"glass", clearGlass()}, {"lamp", lamp({4, 4, 3})}, {"wood", wood}, {"metal", metal}};
  settings.integrator = PathIntegrator{5, 0.01, 2};
  settings.volume.drawn = true;
  settings.volume.cells = {32, 32, 32};
  settings.volume.corner = {-1, -1, -1};
  settings.volume.cellSize = 2.0 / 32;
  settings.volume.blur = 0.12;
  settings.volume.opacity = 12;
  settings.volume.fullDensity = 0.5;
  settings.volume.smokeColour = {0.4f, 0.4f, 0.4f};
  settings.volume.anisotropy = 0.3;
  return {frame, settings};
}

constexpr int pictures = 16, samples = 4, storedSamples = 16;  // n of n x n

Measured measured(int perSide, std::uint64_t firstSeed) {
  auto [frame, settings] = everything();
  settings.samples = perSide;
  std::vector<Vec3d> sum(static_cast<std::size_t>(settings.width) * settings.height), squares = sum;
  for (int n = 0; n < pictures; ++n) {
    settings.seed = firstSeed + n;
    const Image image = renderFrame(frame, settings);
    for (std::size_t p = 0; p < sum.size(); ++p) {
      sum[p] += Vec3d(image.pixels[p]);
      squares[p] += Vec3d(image.pixels[p]) * Vec3d(image.pixels[p]);
    }
  }
  Measured result{Image(settings.width, settings.height), Image(settings.width, settings.height)};
  for (std::size_t p = 0; p < sum.size(); ++p)
    for (int channel = 0; channel < 3; ++channel) {
      const double mean = sum[p][channel] / pictures;
      const double variance = std::max(0.0, squares[p][channel] / pictures - mean * mean) / (pictures - 1);
      result.mean.pixels[p][channel] = static_cast<float>(mean);
      result.deviation.pixels[p][channel] = static_cast<float>(std::sqrt(variance));
    }
  return result;
}

std::filesystem::path stored(const std::string& what) {
  return std::filesystem::path(BRISANCE_SOURCE_DIR) / "tests/render/reference" / (what + ".exr");
}

}  // namespace

// z = difference over its deviation. With deviations from 16 pictures its square has mean 15/13 (Student's t); one
// pixel far off, or all off by a quarter of a deviation, are found.
TEST(ReferencePicture, DiffersFromTheStoredOneByNoMoreThanChance) {
  if (std::getenv("BRISANCE_WRITE_REFERENCE")) {
    const Measured reference = measured(storedSamples, 1000);
    writeDurably(stored("mean"), encodeExr(reference.mean));
    writeDurably(stored("deviation"), encodeExr(reference.deviation));
    GTEST_SKIP() << "written";
  }
  constexpr double halfStep = 0x1p-11;  // relative, of what the file holds
  const Measured now = measured(samples, 1);
  const Image mean = decodeExr(readFile(stored("mean")), "mean"),
              deviation = decodeExr(readFile(stored("deviation")), "deviation");
  ASSERT_EQ(mean.pixels.size(), now.mean.pixels.size());
  double sum = 0, squares = 0, largest = 0;
  for (std::size_t p = 0; p < mean.pixels.size(); ++p)
    for (int channel = 0; channel < 3; ++channel) {
      const double rounding = halfStep * mean.pixels[p][channel];
      const double known = deviation.pixels[p][channel];
      // The stored picture has seen what few samples may all have missed, as the tip of a wall before the sky.
      const double own = std::max<double>(now.deviation.pixels[p][channel], known * storedSamples / samples);
      const double expected = std::sqrt(own * own + known * known + rounding * rounding);
      const double z = (now.mean.pixels[p][channel] - mean.pixels[p][channel]) / expected;
      sum += z;
      squares += z * z;
      largest = std::max(largest, std::abs(z));
    }
  const double count = 3.0 * static_cast<double>(mean.pixels.size());
  EXPECT_LT(squares / count, 1.6);
  EXPECT_LT(std::abs(sum / count), 0.25);
  EXPECT_LT(largest, 8);
}
