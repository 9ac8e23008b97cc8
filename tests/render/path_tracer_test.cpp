#include "render/path_tracer.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "small_pictures.h"

using namespace brisance;

namespace {

struct Estimate {
  double mean, deviation;  ///< of the mean
  double largest;          ///< of all
};

/// All that a test's path meets, with the parts it does not care about empty.
struct Room {
  Room(std::vector<FrameBody> bodies, std::map<std::string, Material> materials, Environment environment_)
      : world(bodies, std::move(materials)),
        shining(bodies, world.materials(), 0),
        environment(std::move(environment_)) {}

  SmallWorld world;
  AreaLights shining;
  Environment environment;
  std::vector<LightSource> lights{};
  const GasMedium* gas = nullptr;
  const FireDirections* fire = nullptr;
  Vec3f albedo{};
  float anisotropy = 0;
  PathIntegrator settings{200, 0.05, 2};

  /// Along rays given by `rayOf(sequence)`, of the red channel.
  template <class RayOf>
  Estimate mean(int count, const RayOf& rayOf) const {
    const PathWorld paths{world.geometry(), world.materials(), lights,   shining, environment, gas, fire,
                          albedo,           anisotropy,        settings, 60};
    const Random random(7, Stream::test);
    double sum = 0, squares = 0, largest = 0;
    for (int i = 0; i < count; ++i) {
      SampleSequence numbers(random.bits(i), 0);  // samples of as many pixels: independent
      const Ray ray = rayOf(numbers);
      const double light = pathRadiance(paths, ray, static_cast<float>(random.uniform(i)), numbers).x;
      sum += light;
      squares += light * light;
      largest = std::max(largest, light);
    }
    const double average = sum / count;
    return {average, std::sqrt(std::max(0.0, squares / count - average * average) / count), largest};
  }
  Estimate along(const Vec3f& origin, const Vec3f& direction, int count) const {
    return mean(count, [&](SampleSequence&) { return Ray{origin, normalized(direction)}; });
  }
};

const Environment white(Vec3f(1, 1, 1)), black(Vec3f(0, 0, 0));

Environment evenPicture() {
  Image picture(8, 4);
  for (Vec3f& pixel : picture.pixels) pixel = {1, 1, 1};
  return {picture, {}};
}

std::map<std::string, Material> fewMaterials() {
  Material brushed = whitePaint();
  brushed.lighting = AshikhminLighting{40, 10};
  brushed.specular = {0.4f, 0.4f, 0.4f};
  Material grey = whitePaint();
  grey.diffuse = SolidColour{{0.6f, 0.6f, 0.6f}};
  return {{"white", whitePaint()},
          {"grey", grey},
          {"glass", clearGlass()},
          {"lamp", lamp({3, 3, 3})},
          {"brushed", brushed}};
}

/// Gas of `extinction` per metre that fills a cube of 2 m about the origin and shines with `glow`.
GasMedium gasCube(float extinction, const Vec3f& glow = {}) {
  VolumeSettings settings;
  settings.blur = 0;
  settings.fullDensity = 1;
  settings.opacity = extinction;
  settings.smokeColour = {0, 0, 0};
  const Vec3d first(-0.95, -0.95, -0.95);
  return {{Grid3<float>({20, 20, 20}, first, 0.1, 1), Grid3<Vec3f>({20, 20, 20}, first, 0.1, glow)}, settings};
}

/// A ball of fire in the middle of a cube of 2 m.
GasMedium fireBall() {
  VolumeSettings settings;
  settings.blur = 0;
  settings.fullDensity = 1;
  settings.opacity = 6;
  const Vec3d first(-0.95, -0.95, -0.95);
  ParticleVolume volume{Grid3<float>({20, 20, 20}, first, 0.1), Grid3<Vec3f>({20, 20, 20}, first, 0.1, {4, 2, 1})};
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 20; ++i)
        volume.density(i, j, k) = static_cast<float>(std::max(0.0, 1 - length(volume.density.position(i, j, k)) / 0.6));
  return {volume, settings};
}

/// Six walls of one material, 3 m apart.
std::vector<FrameBody> darkRoom(const std::string& material) {
  std::vector<FrameBody> walls;
  const Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3d size(3.2, 3.2, 3.2);
      size[axis] = 0.1;
      walls.push_back(
          bodyOf("wall" + std::to_string(walls.size()), boxMesh(size), material, {axes[axis] * (side * 1.55), {}}));
    }
  return walls;
}

Vec3f anyDirection(SampleSequence& numbers) {
  const Vec2<float> where = numbers.pair();
  return samplePhase(0, {0, 0, 1}, where.x, where.y);
}

void expectEqual(const Estimate& a, double b, double slack = 1e-4) {
  EXPECT_NEAR(a.mean, b, 4.5 * a.deviation + slack);
}
void expectSame(const Estimate& a, const Estimate& b) {
  EXPECT_NEAR(a.mean, b.mean, 4.5 * std::hypot(a.deviation, b.deviation));
}

}  // namespace

// A furnace: where light of 1 comes from everywhere, what loses nothing returns 1.
TEST(PathFurnace, WhiteLambertReturnsOne) {
  const std::vector<FrameBody> steps{bodyOf("a", boxMesh({1, 1, 1}), "white"),
                                     bodyOf("b", boxMesh({3, 0.2, 3}), "white", {{0, -0.7, 0}, {}})};
  const Room even(steps, fewMaterials(), white);
  expectEqual(even.along({0.8f, 0.3f, 2}, {-0.1f, -0.6f, -1}, 2000), 1, 2e-3);  // floats added over dozens of bounces
  const Room picture(steps, fewMaterials(), evenPicture());
  const Estimate drawn = picture.along({0.8f, 0.3f, 2}, {-0.1f, -0.6f, -1}, 20000);
  EXPECT_LT(drawn.deviation, 0.01);
  expectEqual(drawn, 1, 2e-3);
}

TEST(PathFurnace, SmoothGlassReturnsOne) {
  const Room room({bodyOf("ball", sphereMesh(1, 48, false), "glass")}, fewMaterials(), white);
  for (const float x : {0.0f, 0.5f, 0.9f}) expectEqual(room.along({x, 0.31f, 4}, {0, 0, -1}, 4000), 1, 2e-3);
}

TEST(PathFurnace, GasThatScattersAllReturnsOne) {
  const GasMedium gas = gasCube(3);
  for (const float anisotropy : {0.0f, 0.7f, -0.5f}) {
    Room room({}, fewMaterials(), white);
    room.gas = &gas;
    room.albedo = {1, 1, 1};
    room.anisotropy = anisotropy;
    expectEqual(room.along({0.2f, 0.1f, 4}, {0, 0, -1}, 2000), 1, 2e-3);
    room.environment = evenPicture();
    expectEqual(room.along({0.2f, 0.1f, 4}, {0, 0, -1}, 20000), 1,
                5e-3);  // lookups between pixels, and the end at 0.999
  }
}

TEST(PathGas, ASlabObeysBeerAndLambertWithoutNoise) {
  const GasMedium gas = gasCube(0.8f);
  Room room({bodyOf("lamp", rectangleMesh(9, 9), "lamp", {{0, 0, -3}, {}})}, fewMaterials(), black);
  room.gas = &gas;
  const Estimate seen = room.along({0.2f, 0.1f, 4}, {0, 0, -1}, 16);
  EXPECT_NEAR(seen.mean, 3 * std::exp(-0.8 * 2), 3e-4);
  EXPECT_NEAR(seen.deviation, 0, 1e-4);
}

// Delta tracking and marching know the same gas: a diffuse wall's light comes through by the one or the other.
TEST(PathGas, CollisionsAreAsFrequentAsTheMarchedOpacity) {
  const GasMedium gas = fireBall();
  const Random random(2, Stream::test);
  constexpr int count = 40000;
  for (const float y : {0.0f, 0.25f, 0.45f}) {
    const GasPath path{{-3, y, 0.03f}, normalized(Vec3f(1, 0, 0.02f)), 0, 10, 0.5f};
    int stopped = 0;
    for (int i = 0; i < count; ++i) {
      NumberRun numbers(random.bits(i));
      stopped += gas.collision(path, numbers).has_value();
    }
    const double opacity = 1 - gas.transmittance(path);
    EXPECT_NEAR(stopped / static_cast<double>(count), opacity, 4.5 * std::sqrt(opacity / count) + 0.003) << y;
  }
}

// An even light of radiance L that fills a rectangle above returns albedo L F, F the form factor of a small patch below
// its middle (Hottel: four corners).
TEST(PathLights, ARectangleLightsAFloorByItsFormFactor) {
  const FrameBody above = bodyOf("lamp", rectangleMesh(1, 1), "lamp", {{0, 1, 0}, axisAngle({1, 0, 0}, pi / 2)});
  const FrameBody floor = bodyOf("floor", rectangleMesh(20, 20), "grey", {{0, 0, 0}, axisAngle({1, 0, 0}, -pi / 2)});
  Room room({above, floor}, fewMaterials(), black);
  room.settings.maxBounces = 1;
  const double s = 0.5 / std::sqrt(1.25);
  const double factor = 4 * (s * std::atan(s) + s * std::atan(s)) / (2 * pi);
  expectEqual(room.along({2, 1, 0}, {-2, -1, 0}, 20000), 0.6 * 3 * factor);
}

TEST(PathLights, ASmallSunAndAPointLightAsWhittedDoes) {
  Room room({bodyOf("wall", rectangleMesh(3, 3), "grey")}, fewMaterials(), black);
  room.settings.maxBounces = 1;
  room.lights = {{LightSource::Kind::point, {0.13f, 1.21f, 1}, {8, 8, 8}, 2, 0}};  // 45 degrees, sqrt(2) m away
  expectEqual(room.along({0.13f, 0.21f, 5}, {0, 0, -1}, 64), 0.6 * 8 / 2 * std::sqrt(0.5));
  room.lights = {{LightSource::Kind::sun, normalized(Vec3f(0, 1, 1)), {2, 2, 2}, 0, 0, std::cos(0.02f)}};
  expectEqual(room.along({0.13f, 0.21f, 5}, {0, 0, -1}, 4000), 0.6 * 2 * std::sqrt(0.5), 2e-4);
}

// The mean light over all directions at A from a point light at B is that at B from A.
TEST(PathReciprocity, LightAndCameraMayBeExchanged) {
  const GasMedium gas = gasCube(1.2f);
  std::vector<FrameBody> bodies = darkRoom("brushed");
  bodies.push_back(bodyOf("box", boxMesh({0.6, 1, 0.4}), "grey", {{0.1, -0.6, 0}, {}}));
  Room room(bodies, fewMaterials(), black);
  room.gas = &gas;
  room.albedo = {0.7f, 0.7f, 0.7f};
  room.anisotropy = 0.4f;
  room.settings.maxBounces = 6;
  const Vec3f a(-1.1f, 0.9f, 0.3f), b(1.2f, 0.2f, -0.8f);
  const auto light = [&](const Vec3f& from, const Vec3f& at) {
    room.lights = {{LightSource::Kind::point, from, {1, 1, 1}, 2, 0}};
    return room.mean(60000, [&](SampleSequence& numbers) { return Ray{at, anyDirection(numbers)}; });
  };
  const Estimate there = light(a, b), back = light(b, a);
  EXPECT_GT(there.mean, 30 * there.deviation);
  expectSame(there, back);
}

// Brute force: the same paths without drawing places in the fire.
TEST(FireInADarkRoom, LightsTheWallsAsManyBlindPathsSay) {
  const GasMedium gas = fireBall();
  const FireDirections fire(gas);
  Room room(darkRoom("grey"), fewMaterials(), black);
  room.gas = &gas;
  room.albedo = {0.2f, 0.2f, 0.2f};
  room.settings.maxBounces = 4;
  for (const Vec3f& wall : {Vec3f(0.7f, 0.5f, -1.5f), Vec3f(-1.5f, -1.1f, 0.2f), Vec3f(0.1f, 1.5f, 0.3f)}) {
    const Vec3f eye = wall * 0.9f, towardsWall = wall - eye;
    room.fire = nullptr;
    const Estimate blind = room.along(eye, towardsWall, 40000);
    room.fire = &fire;
    const Estimate drawn = room.along(eye, towardsWall, 10000);
    EXPECT_LT(blind.deviation, 0.015 * blind.mean);
    expectSame(drawn, blind);
    EXPECT_NEAR(drawn.mean, blind.mean, 0.02 * blind.mean + 3 * std::hypot(blind.deviation, drawn.deviation));
    // That is what it is for: a sample is worth at least two, though the fire is large and easily found by chance.
    EXPECT_LT(drawn.deviation * std::sqrt(10000), std::sqrt(0.5) * blind.deviation * std::sqrt(40000));
  }
}

// The same over whole walls: the light that each of the six returns straight ahead, mean over its area.
TEST(FireInADarkRoom, LightsEachWallWithinTwoPercentOfBruteForce) {
  const GasMedium gas = fireBall();
  const FireDirections fire(gas);
  Room room(darkRoom("grey"), fewMaterials(), black);
  room.gas = &gas;
  room.settings.maxBounces = 2;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      const auto towardsWall = [&](SampleSequence& numbers) {
        const Vec2<float> where = numbers.pair();
        Ray ray;
        ray.origin[axis] = 1.4f * side;
        ray.origin[(axis + 1) % 3] = 2.9f * (where.x - 0.5f);
        ray.origin[(axis + 2) % 3] = 2.9f * (where.y - 0.5f);
        ray.direction[axis] = side;
        return ray;
      };
      room.fire = nullptr;
      const Estimate blind = room.mean(250000, towardsWall);
      room.fire = &fire;
      const Estimate drawn = room.mean(20000, towardsWall);
      EXPECT_LT(blind.deviation, 0.006 * blind.mean);
      EXPECT_NEAR(drawn.mean, blind.mean, 0.02 * blind.mean) << "wall " << axis << " at " << side;
    }
}

// A pane between the fire and a wall: only ways that go through it find light there, so those that are drawn towards
// the fire have to go on through glass.
TEST(FireInADarkRoom, LightsAWallThroughGlass) {
  const GasMedium gas = fireBall();
  const FireDirections fire(gas);
  std::vector<FrameBody> bodies = darkRoom("grey");
  bodies.push_back(bodyOf("pane", boxMesh({0.02, 2.9, 2.9}), "glass", {{1.2, 0, 0}, {}}));
  Room room(bodies, fewMaterials(), black);
  room.gas = &gas;
  room.settings.maxBounces = 2;
  const Vec3f wall(1.5f, 1.2f, 0.9f), eye = wall - Vec3f(0.1f, 0, 0);
  const Estimate blind = room.along(eye, wall - eye, 60000);
  room.fire = &fire;
  const Estimate drawn = room.along(eye, wall - eye, 15000);
  expectSame(drawn, blind);
  EXPECT_LT(drawn.deviation * std::sqrt(15000), 0.5 * blind.deviation * std::sqrt(60000));
}

TEST(FaintPaths, EndWithoutBias) {
  const GasMedium gas = fireBall();
  const FireDirections fire(gas);
  Room room(darkRoom("grey"), fewMaterials(), black);
  room.gas = &gas;
  room.fire = &fire;
  room.settings.faint = 0;
  const Estimate whole = room.along({0, 1.4f, 0.9f}, {0.1f, 1, 0}, 10000);
  room.settings.faint = 0.5;
  const Estimate ended = room.along({0, 1.4f, 0.9f}, {0.1f, 1, 0}, 40000);
  expectSame(whole, ended);
  EXPECT_GT(ended.deviation * std::sqrt(40000), 1.05 * whole.deviation * std::sqrt(10000));  // some did end
}

// A wall 1 cm from thick fire: no draw, be it as near as it may, counts more than fire all around. One draw from the
// fire and one way on make at most twice that.
TEST(FireInADarkRoom, NoPlaceOfItCountsMoreThanFireAllAround) {
  constexpr float glow = 4, grey = 0.6f;
  const GasMedium gas = gasCube(60, {glow, glow, glow});
  const FireDirections fire(gas);
  Room room({bodyOf("wall", boxMesh({0.1, 8, 8}), "grey", {{1.06, 0, 0}, {}})}, fewMaterials(), black);
  room.gas = &gas;
  room.fire = &fire;
  room.settings.maxBounces = 1;
  const Estimate light = room.along({1.005f, 0.03f, 0.02f}, {1, 0, 0}, 100000);
  EXPECT_NEAR(light.mean, grey * glow, 0.01 * grey * glow + 4.5 * light.deviation);
  EXPECT_LT(light.largest, 2 * grey * glow * 1.001f);
}

TEST(PathLights, SurfacesAreFoundAlikeByDrawingThemAndByChance) {
  const std::vector<FrameBody> bodies{bodyOf("lamp", boxMesh({0.8, 0.1, 0.8}), "lamp", {{0, 1, 0}, {}}),
                                      bodyOf("floor", boxMesh({6, 0.1, 6}), "brushed", {{0, -0.1, 0}, {}}),
                                      bodyOf("wall", boxMesh({0.1, 3, 6}), "grey", {{-2, 1, 0}, {}})};
  Room room(bodies, fewMaterials(), black);
  room.settings.maxBounces = 4;
  const Estimate drawn = room.along({1, 1, 1}, {-1, -1, -0.7f}, 40000);
  room.shining = AreaLights({}, room.world.materials(), 0);
  const Estimate blind = room.along({1, 1, 1}, {-1, -1, -0.7f}, 200000);
  expectSame(drawn, blind);
  EXPECT_LT(drawn.deviation, blind.deviation);
}
