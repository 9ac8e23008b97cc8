#include "render/render_frame.h"

#include <gtest/gtest.h>

#include <atomic>

#include "base/check.h"
#include "base/durable_file.h"
#include "base/parallel.h"
#include "base/random.h"
#include "render/picture_file.h"
#include "scratch_directory.h"
#include "small_pictures.h"

using namespace brisance;

namespace {

/// Glass, a mirror, a wall and a little fire: a ray of every kind.
std::pair<Frame, RenderSettings> smallExplosion() {
  Frame frame;
  frame.bodies = {bodyOf("wall", rectangleMesh(4, 4), "white", {{0, 0, -1}, {}}),
                  bodyOf("left", boxMesh({0.5, 1, 0.05}), "glass", {{-0.25, 0, 1}, {}}),
                  bodyOf("right", boxMesh({0.5, 1, 0.05}), "glass", {{0.25, 0, 1}, {}}),
                  bodyOf("ball", sphereMesh(0.4, 16), "chrome", {{0.7, 0.6, 0.5}, {}})};
  const Random random(1, Stream::test);
  for (int p = 0; p < 400; ++p) {
    frame.particles.position.push_back(Vec3f(random.normal3(p) * 0.2));
    frame.particles.velocity.push_back({});
    frame.particles.mass.push_back(0.001f);
    frame.particles.temperature.push_back(static_cast<float>(1500 + 1000 * random.uniform(9000 + p)));
    frame.particles.kind.push_back(static_cast<std::uint8_t>(p % 3));
  }
  RenderSettings settings = smallPicture(4);
  Material chrome = whitePaint();
  chrome.reflection = {0.8f, 0.8f, 0.8f};
  chrome.smooth = true;
  settings.materials = {{"white", whitePaint()}, {"glass", clearGlass()}, {"chrome", chrome}};
  settings.lights = {PointLight{{1, 2, 3}, {5, 5, 5}}, FireLight{1, 3}};
  settings.volume.drawn = true;
  settings.volume.cells = {40, 40, 40};
  settings.volume.corner = {-1, -1, -1};
  settings.volume.cellSize = 0.05;
  settings.volume.blur = 0.1;
  return {frame, settings};
}

/// Every pixel sees the background but where a lamp of 1 m stands in the way.
Image lampPicture(RenderSettings settings, const FrameBody& body) {
  Frame frame;
  frame.bodies = {body};
  settings.materials = {{"lamp", lamp({1, 1, 1})}};
  return renderFrame(frame, settings);
}

Image drawnBy(int threads, const Frame& frame, const RenderSettings& settings) {
  const ThreadLimit limit(threads);
  return renderFrame(frame, settings);
}

double mean(const Image& image) {
  double sum = 0;
  for (const Vec3f& pixel : image.pixels) sum += pixel.x;
  return sum / static_cast<double>(image.pixels.size());
}

}  // namespace

TEST(RenderFrame, OneThreadAndFourMakeTheSamePixels) {
  const auto [frame, settings] = smallExplosion();
  const Image one = drawnBy(1, frame, settings);
  EXPECT_GT(mean(one), 0.01);
  EXPECT_EQ(contentHash(one), contentHash(drawnBy(4, frame, settings)));
}

TEST(RenderFrame, EndsEarlyWhenAskedTo) {
  const auto [frame, settings] = smallExplosion();
  for (const Integrator& integrator : {Integrator(WhittedIntegrator{}), Integrator(PathIntegrator{})}) {
    RenderSettings look = settings;
    look.integrator = integrator;
    std::atomic<int> asked = 0;
    RenderScratch scratch;
    const StopRequested atTheTenth = [&] { return ++asked >= 10; };
    EXPECT_THROW(drawFilmFrame(frame, look, RenderAssets(look), {}, scratch, atTheTenth), Interrupted);
    EXPECT_LT(asked, look.width * look.height / 2);
  }
}

TEST(RenderFrame, PathsAreTheSameForOneThreadAndFour) {
  auto [frame, settings] = smallExplosion();
  settings.integrator = PathIntegrator{};
  const Image one = drawnBy(1, frame, settings);
  EXPECT_GT(mean(one), 0.01);
  EXPECT_EQ(contentHash(one), contentHash(drawnBy(4, frame, settings)));
}

// Where no light goes further than appendix A follows it, both integrators see the same.
TEST(RenderFrame, BothIntegratorsAgreeOnAWallUnderAPointLight) {
  auto [frame, settings] = smallExplosion();
  frame.bodies.resize(1);
  settings.volume.drawn = false;
  settings.samples = 4;
  settings.lights.resize(1);
  const Image whitted = renderFrame(frame, settings);
  settings.integrator = PathIntegrator{1, 1, 0, false};
  const Image path = renderFrame(frame, settings);
  for (std::size_t p = 0; p < whitted.pixels.size(); ++p)
    EXPECT_NEAR(whitted.pixels[p].x, path.pixels[p].x, 1e-4f + 1e-4f * whitted.pixels[p].x);
}

TEST(RenderFrame, ASeedChangesTheJitterAndNotThePicture) {
  auto [frame, settings] = smallExplosion();
  settings.samples = 4;
  const Image first = renderFrame(frame, settings);
  settings.seed = 2;
  const Image second = renderFrame(frame, settings);
  EXPECT_NE(contentHash(first), contentHash(second));
  EXPECT_NEAR(mean(first), mean(second), 0.02 * mean(first));
}

TEST(RenderFrame, UnburntFuelIsNotSeenAndBurningFuelIs) {
  auto [frame, settings] = smallExplosion();
  frame.bodies.clear();
  std::fill(frame.particles.kind.begin(), frame.particles.kind.end(), std::uint8_t{0});
  EXPECT_EQ(mean(renderFrame(frame, settings)), 0);
  std::fill(frame.particles.kind.begin(), frame.particles.kind.end(), std::uint8_t{1});
  const double burning = mean(renderFrame(frame, settings));
  EXPECT_GT(burning, 0);
  settings.volume.drawn = false;
  EXPECT_EQ(mean(renderFrame(frame, settings)), 0);
}

// The picture is 5 m away and 40 degrees high: 3.64 m, so that a lamp of 1 m covers (1 / 3.64)^2 of it.
TEST(RenderFrame, ABodyCoversItsShareOfThePicture) {
  RenderSettings settings = smallPicture();
  settings.width = settings.height = 64;
  settings.samples = 4;
  const Image image = lampPicture(settings, bodyOf("lamp", rectangleMesh(1, 1), "lamp"));
  const double expected = std::pow(1 / (10 * std::tan(20 * pi / 180)), 2);
  EXPECT_NEAR(mean(image), expected, 0.02 * expected);  // 70 pixels of the edge, 16 jittered samples each
  EXPECT_FLOAT_EQ(image(32, 32).x, 1);
  EXPECT_EQ(image(0, 0).x, 0);
}

TEST(RenderFrame, PicturesAreUprightAndNotMirrored) {
  RenderSettings settings = smallPicture();
  const Image above = lampPicture(settings, bodyOf("lamp", rectangleMesh(0.5, 0.5), "lamp", {{0, 1.2, 0}, {}}));
  EXPECT_EQ(above(16, 5).x, 1);
  EXPECT_EQ(above(16, 26).x, 0);
  const Image right = lampPicture(settings, bodyOf("lamp", rectangleMesh(0.5, 0.5), "lamp", {{1.2, 0, 0}, {}}));
  EXPECT_EQ(right(26, 16).x, 1);
  EXPECT_EQ(right(5, 16).x, 0);
}

TEST(RenderFrame, ATextureLiesOnARectangleAsItLooks) {
  const ScratchDirectory scratch;
  const auto file = scratch / "four.png";  // upper row red, green; lower row blue, white
  writeDurably(file, encodePng({2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}}));
  RenderSettings settings = smallPicture();
  Material material = lamp({1, 1, 1});
  material.diffuse = ImageTexture{file};
  settings.materials = {{"four", material}};
  Frame frame;
  frame.bodies = {bodyOf("picture", rectangleMesh(3, 3), "four")};
  const Image image = renderFrame(frame, settings);
  const auto dominant = [&](int x, int y) {
    const Vec3f& c = image(x, y);
    return (c.x > 0.9f ? 1 : 0) + (c.y > 0.9f ? 2 : 0) + (c.z > 0.9f ? 4 : 0);
  };
  EXPECT_EQ(dominant(9, 9), 1);
  EXPECT_EQ(dominant(22, 9), 2);
  EXPECT_EQ(dominant(9, 22), 4);
  EXPECT_EQ(dominant(22, 22), 7);
}

// Half a picture per frame to the right: while the shutter is open all frame long, the lamp's light spreads over its
// way.
TEST(Shutter, SmearsABodyThatMovesAndKeepsItsLight) {
  RenderSettings settings = smallPicture();
  settings.samples = 4;
  FrameBody body = bodyOf("lamp", rectangleMesh(0.5, 0.5), "lamp");
  body.linearVelocity = {24, 0, 0};  // 1 m in 1/24 s
  const Image sharp = lampPicture(settings, body);
  settings.camera.shutter = 1;
  const Image smeared = lampPicture(settings, body);
  EXPECT_FLOAT_EQ(sharp(16, 16).x, 1);
  EXPECT_EQ(sharp(21, 16).x, 0);
  EXPECT_NEAR(smeared(16, 16).x, 0.5, 0.13);  // 0.5 m of a way of 1 m, in sixteen times
  EXPECT_GT(smeared(20, 16).x, 0.05f);        // centred on the pose: as far to the right
  EXPECT_GT(smeared(11, 16).x, 0.05f);        // as to the left
  EXPECT_NEAR(mean(smeared), mean(sharp), 0.06 * mean(sharp));
}

TEST(Shutter, SmearsEverythingWhenTheCameraMoves) {
  RenderSettings settings = smallPicture();
  settings.samples = 4;
  settings.camera.shutter = 0.5;
  settings.camera.keys = {{-1, {-48, 0, 5}, {-48, 0, 0}, {0, 1, 0}, 40}, {1, {48, 0, 5}, {48, 0, 0}, {0, 1, 0}, 40}};
  FrameBody body = bodyOf("lamp", rectangleMesh(0.5, 0.5), "lamp");
  body.moves = false;
  const Image image = lampPicture(settings, body);  // 48 m/s for 1/48 s: 1 m
  EXPECT_NEAR(image(16, 16).x, 0.5, 0.13);
  EXPECT_GT(image(20, 16).x, 0.05f);
}

TEST(RenderAssets, ATextureThatIsMissingIsTheUsersMistake) {
  RenderSettings settings = smallPicture();
  settings.materials["wall"].diffuse = ImageTexture{"/no/such/brick.png"};
  EXPECT_THROW(RenderAssets{settings}, InputError);
}
