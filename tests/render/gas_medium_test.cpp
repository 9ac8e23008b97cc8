#include "render/gas_medium.h"

#include <gtest/gtest.h>

#include "render/fire_lights.h"
#include "render/lights.h"

using namespace brisance;

namespace {

constexpr float rounding = 2e-5f;  // some hundred steps of float sums and exponentials

VolumeSettings plainSettings() {
  VolumeSettings settings;
  settings.blur = 0;
  settings.fullDensity = 4;
  settings.opacity = 3;
  settings.smokeColour = {0, 0, 0};
  return settings;
}

/// `cells` cells of 0.1 m from the origin, full of gas of one density and colour.
ParticleVolume slab(const Vec3i& cells, float density, const Vec3f& colour = {1, 0.5f, 0.25f}) {
  const Vec3d centre(0.05, 0.05, 0.05);
  return {Grid3<float>(cells, centre, 0.1, density), Grid3<Vec3f>(cells, centre, 0.1, colour)};
}

GasPath alongX(float phase = 0.5f) { return {{-5, 0.81f, 0.77f}, {1, 0, 0}, 0, 100, phase}; }

}  // namespace

// kappa = opacity * density / fullDensity = 3 * 2 / 4 = 1.5 per metre over 1.6 m.
TEST(GasMedium, ASlabObeysBeerAndLambertBothWays) {
  const GasMedium gas(slab({16, 16, 16}, 2), plainSettings());
  const double through = std::exp(-1.5 * 1.6);
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {1.f, -1.f})
      for (const float phase : {0.f, 0.3f, 0.99f}) {
        GasPath path{{0.8f, 0.8f, 0.8f}, {}, 0, 100, phase};
        path.direction[axis] = sign;
        path.origin[axis] -= sign * 3;
        const GasPassage passage = gas.march(path);
        EXPECT_NEAR(passage.transmittance, through, rounding);
        EXPECT_NEAR(passage.light.x, 1 - through, rounding);
        EXPECT_NEAR(passage.light.y, 0.5 * (1 - through), rounding);
      }
}

TEST(GasMedium, AnObliqueWayIsAsLongAsItIs) {
  const GasMedium gas(slab({16, 16, 16}, 2), plainSettings());
  const Vec3f direction = normalized(Vec3f(1, 1, 1));
  const GasPassage passage = gas.march({Vec3f(0.8f, 0.8f, 0.8f) - direction * 4.f, direction, 0, 100, 0.2f});
  EXPECT_NEAR(passage.transmittance, std::exp(-1.5 * 1.6 * std::sqrt(3)), rounding);
}

TEST(GasMedium, PartsOfAWayJoinToTheWhole) {
  const GasMedium gas(slab({16, 16, 16}, 2), plainSettings());
  const GasPassage whole = gas.march(alongX());
  for (const float cut : {5.01f, 5.5f, 6.3333f}) {
    GasPath front = alongX(), back = alongX();
    front.far = back.near = cut;
    const GasPassage a = gas.march(front), b = gas.march(back);
    EXPECT_NEAR(a.transmittance * b.transmittance, whole.transmittance, rounding);
    EXPECT_NEAR(a.light.x + a.transmittance * b.light.x, whole.light.x, rounding);
  }
}

// Ways of all kinds, some more than a packet: through the gas, beside it, along an axis, cut before, in and behind it.
TEST(GasMedium, WaysSideBySideSeeWhatEachSeesAlone) {
  ParticleVolume volume = slab({40, 24, 32}, 0);
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 40; ++i) {
        const double wave = std::sin(0.4 * i) * std::cos(0.3 * j) + 0.2 * std::sin(0.5 * k);
        volume.density(i, j, k) = i / 8 == 2 ? 0 : static_cast<float>(std::max(0.0, 4 * wave));
        volume.colour(i, j, k) = {1, 0.1f * static_cast<float>(k), 0.5f};
      }
  const GasMedium gas(volume, plainSettings());
  std::vector<GasPath> paths{alongX(), {{2, 5, 1}, {0, 1, 0}, 0, 100, 0.1f}, {{2, -1, 1}, {0, 1, 0}, 1.3f, 2.2f, 0.9f}};
  for (int n = 0; n < 50; ++n) {
    const Vec3f from(-2 + 0.1f * static_cast<float>(n), -3, 0.3f * static_cast<float>(n % 11));
    paths.push_back({from, normalized(Vec3f(1, 1.2f, 1.6f) - from), 0.02f * static_cast<float>(n),
                     4.5f + 0.9f * static_cast<float>(n % 7), 0.02f * static_cast<float>(n)});
  }
  std::vector<GasPassage> passages(paths.size());
  gas.march(paths, passages);
  int inGas = 0;
  for (std::size_t n = 0; n < paths.size(); ++n) {
    const GasPassage alone = gas.march(paths[n]);
    inGas += alone.transmittance < 0.95f;
    EXPECT_NEAR(passages[n].transmittance, alone.transmittance, rounding) << n;
    EXPECT_NEAR(passages[n].light.x, alone.light.x, rounding) << n;
    EXPECT_NEAR(passages[n].light.y, alone.light.y, 3 * rounding) << n;
  }
  EXPECT_GT(inGas, 15);
}

TEST(GasBrick, CodesKeepTenBitsOfTheFraction) {
  for (const float value : {1e-6f, 0.0123f, 1.0f, 3.14159f, 8e5f}) {
    const std::uint32_t word = GasCode::of(value) | GasCode::of(2 * value) << 16;
    EXPECT_NEAR(GasCode::lower(word) * GasCode::unit, value, value / 2048);
    EXPECT_NEAR(GasCode::upper(word) * GasCode::unit, 2 * value, value / 1024);
  }
  EXPECT_EQ(GasCode::of(0), 0u);
  EXPECT_EQ(GasCode::of(1e-9f), 0u);
  EXPECT_EQ(GasCode::of(-1), 0u);
  EXPECT_EQ(GasCode::of(std::numeric_limits<float>::quiet_NaN()), 0u);
  EXPECT_NEAR(GasCode::lower(GasCode::of(1e30f)) * GasCode::unit / GasCode::largest, 1, 1e-3);
}

// As many fire points as blocks: each lies in the middle of one, which it lights too.
TEST(GasMedium, FireInTheMiddleOfABlockLightsItFinitely) {
  VolumeSettings settings = plainSettings();
  settings.smokeColour = {0.5f, 0.5f, 0.5f};
  settings.emission = 1;
  GasMedium gas(slab({8, 8, 8}, 2), settings);
  gas.illuminate({}, lightSources({FireLight{.strength = 1, .lights = 8}}, &gas));
  const GasPassage passage = gas.march({{-5, 0.41f, 0.37f}, {1, 0, 0}, 0, 100, 0.5f});
  EXPECT_GT(passage.light.x, 1 - passage.transmittance);
  EXPECT_LT(passage.light.x, 3);
}

TEST(GasMedium, WaysBesideTheGasAreFree) {
  const GasMedium gas(slab({16, 16, 16}, 2), plainSettings());
  GasPath beside = alongX();
  beside.origin.y = 1.7f;
  EXPECT_EQ(gas.march(beside).transmittance, 1);
  GasPath before = alongX();
  before.far = 4.9f;
  EXPECT_EQ(gas.march(before).transmittance, 1);
  const GasMedium nothing(slab({16, 16, 16}, 0), plainSettings());
  EXPECT_EQ(nothing.march(alongX()).transmittance, 1);
}

// Two thin sheets of gas far apart: the empty blocks between them are skipped, the sheets are not.
TEST(GasMedium, SkippingEmptyBlocksLosesNoGas) {
  ParticleVolume volume = slab({96, 16, 16}, 0);
  for (const int sheet : {9, 10, 11, 80, 81})
    for (int k = 0; k < 16; ++k)
      for (int j = 0; j < 16; ++j) volume.density(sheet, j, k) = 4;
  const GasMedium gas(volume, plainSettings());
  // Linear flanks of one cell on either side count half each: the integral is that of the samples, 5 cells of 0.1 m.
  const double depth = 3 * 0.5;
  double sum = 0;
  constexpr int phases = 64;
  for (int p = 0; p < phases; ++p)
    sum += std::log(gas.march(alongX((static_cast<float>(p) + 0.5f) / phases)).transmittance);
  EXPECT_NEAR(-sum / phases, depth, 1e-3 * depth);
}

// The blurred volume of a single particle: a step of half a deviation integrates a Gaussian exactly, so that no bands
// are seen.
TEST(GasMedium, TheStepIsFineEnoughForTheBlur) {
  VolumeSettings settings = plainSettings();
  settings.blur = 0.4;  // four cells
  ParticleVolume volume = slab({64, 16, 16}, 0);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 64; ++i) {
        const double x = (i - 31.5) * 0.1 / settings.blur;
        volume.density(i, j, k) = static_cast<float>(std::exp(-0.5 * x * x));
      }
  const GasMedium gas(volume, settings);
  const double depth = 0.75 * settings.blur * std::sqrt(2 * pi);
  for (const float phase :
       {0.f, 0.25f, 0.5f, 0.75f})  // 0.2 % : a deviation grows by linear interpolation to sigma + h^2/(12 sigma)
    EXPECT_NEAR(-std::log(gas.march(alongX(phase)).transmittance), depth, 2e-3 * depth);
}

TEST(GasMedium, TheEarlyEndCostsAtMostAThousandthOfWhatLiesBehind) {
  VolumeSettings settings = plainSettings();
  settings.opacity = 40;
  const GasMedium gas(slab({16, 16, 16}, 4), settings);
  const GasPassage passage = gas.march(alongX());
  EXPECT_EQ(passage.transmittance, 0);
  EXPECT_GE(passage.light.x, 0.999f);
  EXPECT_LE(passage.light.x, 1 + rounding);
}

/// Smoke that scatters half of all light.
GasMedium smoke(float density) {
  VolumeSettings settings = plainSettings();
  settings.smokeColour = {0.5f, 0.5f, 0.5f};
  return {slab({32, 32, 32}, density, {0, 0, 0}), settings};
}

TEST(GasMedium, ThinColdSmokeShowsTheAmbientLight) {
  GasMedium gas = smoke(1e-3f);
  gas.illuminate({0.2f, 0.4f, 0.8f}, {});
  const GasPassage passage = gas.march(alongX());
  const float opacity = 1 - passage.transmittance;
  const float dimming = 0.01f;  // the smoke's own shade: an optical depth of 0.0024 to each side
  EXPECT_NEAR(passage.light.x / opacity, 0.1f, 0.1f * dimming);
  EXPECT_NEAR(passage.light.z / opacity, 0.4f, 0.4f * dimming);
}

TEST(GasMedium, ThickSmokeIsBrightOnTheSunnySideAndDarkBehind) {
  for (const float sign : {1.f, -1.f}) {
    GasMedium gas = smoke(4);
    LightSource sun{LightSource::Kind::sun, {sign, 0, 0}, {1, 1, 1}};
    gas.illuminate({}, {sun});
    const GasPath fromRight{{8, 1.61f, 1.57f}, {-1, 0, 0}, 0, 100}, fromLeft{{-5, 1.61f, 1.57f}, {1, 0, 0}, 0, 100};
    const float sunny = gas.march(sign > 0 ? fromRight : fromLeft).light.x,
                shady = gas.march(sign > 0 ? fromLeft : fromRight).light.x;
    EXPECT_GT(sunny, 20 * shady);
    EXPECT_LE(sunny, 0.5f * 0.25f);  // no more than its albedo's share of a quarter of I_s
  }
}

TEST(GasOptics, OpacityStartsAtZeroAndEndsAtTheFullDensity) {
  VolumeSettings settings = plainSettings();
  settings.minDensity = 0.2;
  const GasOptics optics(settings);
  EXPECT_EQ(optics.extinction(0), 0);
  EXPECT_LT(optics.extinction(1e-4f), 1e-3f);  // no rim
  EXPECT_NEAR(optics.extinction(4), 3, 1e-6);  // opacity * max_d
  EXPECT_EQ(optics.extinction(400), optics.extinction(4));
  EXPECT_NEAR(optics.extinction(2), 3 * (0.2 + 0.8 * 0.5), 1e-6);
}

TEST(GasShadow, ABlockMeanGivesTheSlabsTransmittance) {
  const GasMedium gas(slab({16, 16, 16}, 2), plainSettings());
  EXPECT_NEAR(gas.roughTransmittance(alongX()), std::exp(-1.5 * 1.6), rounding);
}

// The light at distance r from a small thin ball of gas: the radiance of the ray through its centre is kappa I 2 R,
// that of all rays together, over their solid angles, sum(kappa I V) / r^2.
TEST(FirePoints, InThinGasTheirIntensityIsTheSeenLight) {
  VolumeSettings settings = plainSettings();
  settings.opacity = 1e-3;
  const GasMedium gas(slab({16, 16, 16}, 4), settings);
  const std::vector<FirePoint> points = findFirePoints(gas, 4);
  ASSERT_EQ(points.size(), 4u);
  Vec3f sum;
  for (const FirePoint& point : points) sum += point.intensity;
  const double volume = 1.6 * 1.6 * 1.6;
  EXPECT_NEAR(sum.x / (1e-3 * volume), 1, 1e-3);  // the mean depth of half the slab, 8e-4, is absorbed
  EXPECT_NEAR(sum.y / sum.x, 0.5, 1e-6);
}

TEST(FirePoints, ThickGasKeepsMostOfItsLightToItself) {
  VolumeSettings settings = plainSettings();
  settings.opacity = 10;
  const GasMedium gas(slab({32, 32, 32}, 4), settings);
  const std::vector<FirePoint> points = findFirePoints(gas, 1);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_LT(points[0].intensity.x, 0.25 * 10 * 3.2 * 3.2 * 3.2);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(points[0].position[axis], 1.6, 1e-3);  // by symmetry its middle
}

TEST(FirePoints, ColdGasHasNone) {
  const GasMedium gas(slab({16, 16, 16}, 4, {0, 0, 0}), plainSettings());
  EXPECT_TRUE(findFirePoints(gas, 8).empty());
}

TEST(FirePoints, ClustersShareTheLightAboutEvenly) {
  VolumeSettings settings = plainSettings();
  settings.opacity = 1e-3;
  const GasMedium gas(slab({64, 64, 64}, 4), settings);
  const std::vector<FirePoint> points = findFirePoints(gas, 5);
  ASSERT_EQ(points.size(), 5u);
  const double all = 4e-3 * 0.25 * std::pow(6.4, 3);
  for (const FirePoint& point : points)
    EXPECT_NEAR(point.intensity.x / (all / 5), 1, 0.35);  // whole slices of blocks go together
}

TEST(FirePoints, OneBlockIsNoPointWithoutExtent) {
  const GasMedium gas(slab({8, 8, 8}, 4), plainSettings());
  const std::vector<FirePoint> points = findFirePoints(gas, 4);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_FLOAT_EQ(points[0].radius, 0.4f);  // half of 8 cells of 0.1 m
}

TEST(Lights, FallWithThePowerOfTheDistance) {
  const std::vector<LightSource> lights = lightSources(
      {PointLight{{0, 2, 0}, {4, 4, 4}, 2}, PointLight{{0, 2, 0}, {4, 4, 4}, 0}, SunLight{{0, -3, 0}, {5, 5, 5}}},
      nullptr);
  ASSERT_EQ(lights.size(), 3u);
  EXPECT_FLOAT_EQ(lights[0].at({0, 0, 0}).intensity.x, 1);
  EXPECT_FLOAT_EQ(lights[1].at({0, 0, 0}).intensity.x, 4);
  EXPECT_FLOAT_EQ(lights[2].at({7, 0, 0}).intensity.x, 5);
  for (const LightSource& light : lights) EXPECT_NEAR(light.at({0, 0, 0}).toLight.y, 1, 1e-6);
}

TEST(Lights, FireLightOverPiIsWhatAWhiteWallReturns) {
  VolumeSettings settings = plainSettings();
  settings.opacity = 1e-3;
  const GasMedium gas(slab({16, 16, 16}, 4), settings);
  const std::vector<LightSource> lights = lightSources({FireLight{2, 1}}, &gas);
  ASSERT_EQ(lights.size(), 1u);
  const ArrivingLight far = lights[0].at({100.8f, 0.8f, 0.8f});
  const double irradiance = 1e-3 * 1.6 * 1.6 * 1.6 / (100 * 100);
  EXPECT_NEAR(far.intensity.x / (2 * irradiance / pi), 1,
              2e-3);  // absorbed: 8e-4; the cluster's radius over 100 m: 1e-4
}
