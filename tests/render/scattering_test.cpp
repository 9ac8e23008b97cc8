#include "render/scattering.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "render/dielectric.h"

using namespace brisance;

namespace {

Vec3f towards(float polar, float around) {
  return {std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)};
}

/// Integral over all directions of f(direction), by the midpoint rule in both angles.
template <class F>
double overSphere(F f) {
  constexpr int rows = 600, columns = 300;
  double sum = 0;
  for (int row = 0; row < rows; ++row) {
    const auto polar = static_cast<float>(pi * (row + 0.5) / rows);
    for (int column = 0; column < columns; ++column)
      sum += std::sin(polar) * f(towards(polar, static_cast<float>(2 * pi * (column + 0.5) / columns)));
  }
  return sum * 2 * pi * pi / (rows * columns);
}

double albedoByQuadrature(const SurfaceScattering& surface, const Vec3f& out) {
  return overSphere([&](const Vec3f& in) { return value(surface, out, in).x; });
}

/// Mean weight of samples, and its deviation.
struct Estimate {
  double mean, deviation;
};
Estimate albedoBySamples(const SurfaceScattering& surface, const Vec3f& out) {
  const Random random(3, Stream::test);
  constexpr int count = 200000;
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const auto number = [&](int n) { return static_cast<float>(random.uniform(3 * i + n)); };
    const auto drawn = sample(surface, out, {number(0), number(1), number(2)});
    const double weight = drawn ? drawn->weight.x : 0;
    sum += weight;
    squares += weight * weight;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / count)};
}

const Vec3f grey{0.5f, 0.5f, 0.5f}, dim{0.3f, 0.3f, 0.3f};

std::vector<SurfaceScattering> ashikhminSurfaces() {
  return {AshikhminShirley{grey, dim, 10, 10}, AshikhminShirley{grey, dim, 100, 5},
          AshikhminShirley{{1, 1, 1}, {0.05f, 0.05f, 0.05f}, 30, 60}, AshikhminShirley{{}, {1, 1, 1}, 8, 50}};
}
std::vector<SurfaceScattering> allSurfaces() {
  std::vector<SurfaceScattering> all = ashikhminSurfaces();
  all.insert(all.end(), {Lambert{grey}, Phong{grey, dim, 12}, RoughDielectric{1 / 1.5f, 0.3f},
                         RoughDielectric{1.5f, 0.3f}, RoughDielectric{1 / 1.5f, 0.6f}});
  return all;
}

}  // namespace

TEST(AshikhminShirley, ReturnsTheSameWhenLightAndEyeAreExchanged) {
  for (const SurfaceScattering& surface : ashikhminSurfaces())
    for (const float a : {0.1f, 0.8f, 1.4f})
      for (const float b : {0.3f, 1.2f}) {
        const Vec3f out = towards(a, 0.4f), in = towards(b, 2.5f);
        const float there = value(surface, out, in).x / in.z, back = value(surface, in, out).x / out.z;
        EXPECT_NEAR(there, back, 1e-5f * there);
      }
}

TEST(AshikhminShirley, ReturnsNoMoreLightThanItGets) {
  for (const SurfaceScattering& surface : ashikhminSurfaces())
    for (const float polar : {0.0f, 0.5f, 1.0f, 1.3f, 1.5f})
      EXPECT_LE(albedoByQuadrature(surface, towards(polar, 0.7f)), 1 + 1e-3);
}

// The midpoint rule with steps of 0.3 degrees errs by less than 0.3 % for these lobes.
TEST(Scattering, SamplesReturnWhatTheValueIntegratesTo) {
  for (const SurfaceScattering& surface : allSurfaces())
    for (const float polar : {0.05f, 0.6f, 1.2f}) {
      const Vec3f out = towards(polar, 0.7f);
      const Estimate estimate = albedoBySamples(surface, out);
      const double exact = albedoByQuadrature(surface, out);
      EXPECT_NEAR(estimate.mean, exact, 4 * estimate.deviation + 0.003 * exact) << surface.index() << " " << polar;
    }
}

// A density that is too small or too large somewhere makes the share of samples there differ from its integral.
TEST(Scattering, SamplesFallWhereTheDensitySays) {
  const Random random(4, Stream::test);
  constexpr int count = 100000;
  for (const SurfaceScattering& surface : allSurfaces()) {
    const Vec3f out = towards(0.7f, 0.3f);
    const auto inOctant = [](const Vec3f& in, int octant) {
      return (in.x > 0) == ((octant & 1) != 0) && (in.y > 0) == ((octant & 2) != 0) &&
             (in.z > 0) == ((octant & 4) != 0);
    };
    std::array<int, 8> found{};
    for (int i = 0; i < count; ++i) {
      const auto number = [&](int n) { return static_cast<float>(random.uniform(3 * i + n)); };
      const auto drawn = sample(surface, out, {number(0), number(1), number(2)});
      for (int octant = 0; drawn && octant < 8; ++octant) found[octant] += inOctant(drawn->in, octant);
    }
    for (int octant = 0; octant < 8; ++octant) {
      const double expected =
          overSphere([&](const Vec3f& in) { return inOctant(in, octant) ? density(surface, out, in) : 0; });
      const double deviation = std::sqrt(expected * (1 - std::min(1.0, expected)) / count);
      EXPECT_NEAR(static_cast<double>(found[octant]) / count, expected, 4.5 * deviation + 0.004) << surface.index();
    }
  }
}

TEST(RoughGlass, LosesLittleAndMirrorsLikeSmoothGlassWhereItIsNearlySmooth) {
  const Vec3f out = towards(0.8f, 0);
  EXPECT_NEAR(albedoBySamples(RoughDielectric{1 / 1.5f, 0.05f}, out).mean, 1, 0.005);
  const Random random(5, Stream::test);
  constexpr int count = 100000;
  int mirrored = 0;
  for (int i = 0; i < count; ++i) {
    const auto number = [&](int n) { return static_cast<float>(random.uniform(3 * i + n)); };
    const auto drawn = sample(RoughDielectric{1 / 1.5f, 0.02f}, out, {number(0), number(1), number(2)});
    mirrored += drawn && drawn->in.z > 0;
  }
  EXPECT_NEAR(mirrored / static_cast<double>(count), fresnelReflectance(out.z, 1 / 1.5f), 0.004);
}

TEST(SmoothGlass, GoesEitherWayByFresnelsShares) {
  const Vec3f out = towards(1.1f, 0.2f);
  const float mirrorShare = fresnelReflectance(out.z, 1 / 1.5f);
  const SmoothDielectric glass{1 / 1.5f};
  EXPECT_GT(sample(glass, out, {0, 0, mirrorShare - 1e-4f})->in.z, 0);
  const auto through = sample(glass, out, {0, 0, mirrorShare + 1e-4f});
  EXPECT_NEAR(std::sqrt(1 - through->in.z * through->in.z), std::sin(1.1f) / 1.5f, 1e-5);  // Snell
  EXPECT_GT(sample(SmoothDielectric{1.5f}, out, {0, 0, 0.999f})->in.z, 0);                 // total reflection
}

TEST(PhaseFunction, IntegratesToOneWithItsMeanCosine) {
  for (const float g : {-0.7f, -0.2f, 0.0f, 0.3f, 0.8f}) {
    EXPECT_NEAR(overSphere([&](const Vec3f& way) { return phaseFunction(g, way.z); }), 1, 2e-3);
    EXPECT_NEAR(overSphere([&](const Vec3f& way) { return phaseFunction(g, way.z) * way.z; }), g, 2e-3);
    const Random random(6, Stream::test);
    const Vec3f onward = normalized(Vec3f(1, 2, -0.5f));
    constexpr int count = 100000;
    double cosines = 0;
    for (int i = 0; i < count; ++i)
      cosines += dot(onward, samplePhase(g, onward, static_cast<float>(random.uniform(2 * i)),
                                         static_cast<float>(random.uniform(2 * i + 1))));
    EXPECT_NEAR(cosines / count, g, 4 / std::sqrt(3.0 * count) + 1e-3);
  }
}

TEST(Axes, AreRightHandedUnitAndAlongU) {
  const Axes axes(normalized(Vec3f(1, 2, 3)), {1, 0, 0});
  EXPECT_NEAR(length(axes.x), 1, 1e-6f);
  EXPECT_NEAR(dot(axes.x, axes.z), 0, 1e-6f);
  EXPECT_NEAR(length(cross(axes.x, axes.y) - axes.z), 0, 1e-6f);
  EXPECT_GT(axes.x.x, 0.9f);
  const Axes any(Vec3f(0, 0, 1), {0, 0, 5});  // u along the normal tells nothing
  EXPECT_NEAR(length(any.x), 1, 1e-6f);
}
