#include "fluid/advection.h"

#include "base/parallel.h"
#include "base/random.h"
#include "base/vector_path.h"
#include "fluid/fluid_fixture.h"

namespace brisance {
namespace {
using namespace test;

/// A smooth swirling flow without walls, of speeds up to about 1.
void swirl(FluidState& gas) {
  setComponent(gas.velocity.u, [](const Vec3d& p) { return std::sin(3 * p.y + 1) + 0.3 * p.x; });
  setComponent(gas.velocity.v, [](const Vec3d& p) { return std::cos(4 * p.z) - 0.6 * p.y; });
  setComponent(gas.velocity.w, [](const Vec3d& p) { return std::sin(2 * p.x) * std::cos(p.y) + 0.2; });
}

void blob(Grid3<float>& grid, float background) {
  setComponent(grid, [&](const Vec3d& p) {
    const Vec3d d = p - Vec3d(.4, .45, .55);
    return background + 5 * std::exp(-dot(d, d) / 0.02);
  });
}

/// A law that every scheme keeps.
class AnyScheme : public testing::TestWithParam<AdvectionScheme> {};

const AdvectionScheme schemes[] = {DonorCell{1}, DonorCell{0}, MacCormack{true}, MacCormack{false}, SemiLagrangian{}};
std::string nameOf(const testing::TestParamInfo<AdvectionScheme>& tested) {
  const char* names[] = {"Upwind", "Central", "MacCormack", "UnclampedMacCormack", "SemiLagrangian"};
  return names[tested.index];
}
INSTANTIATE_TEST_SUITE_P(Advection, AnyScheme, testing::ValuesIn(schemes), nameOf);

TEST_P(AnyScheme, AConstantStaysConstantEvenWhereGasIsCreated) {
  FluidSettings s = box({12, 10, 8});
  s.advection = GetParam();
  FluidState gas = gasIn(s);
  swirl(gas);  // its divergence is not zero
  Grid3<float> scalar = cellGrid(s, 7.0f);
  AdvectionScratch scratch;
  for (int n = 0; n < 20; ++n) advectScalar(scalar, gas, s, 7.0f, 0.02, scratch);
  for (const float value : scalar.values) EXPECT_NEAR(value, 7, 7e-6);
}

TEST_P(AnyScheme, AUniformWindStaysUniformWithEitherSign) {
  for (const float sign : {1.0f, -1.0f}) {
    FluidSettings s = box({9, 8, 7});
    s.advection = GetParam();
    s.wind = Vec3d(1, 2, 3) * double(sign);
    FluidState gas = gasIn(s);
    EXPECT_EQ(gas.velocity.w(3, 3, 3), 3 * sign);
    AdvectionScratch scratch;
    const MacVelocity before = gas.velocity;
    advectVelocity(gas, s, 0.01, scratch);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LT(largestDifference(gas.velocity.component(axis).values, before.component(axis).values), 1e-6);
  }
}

TEST(Advection, UpwindClampedAndTracedStepsMakeNoNewExtrema) {
  for (const AdvectionScheme& scheme : std::vector<AdvectionScheme>{DonorCell{1}, MacCormack{true}, SemiLagrangian{}}) {
    FluidSettings s = box({16, 16, 16});
    s.advection = scheme;
    FluidState gas = gasIn(s);
    swirl(gas);
    Grid3<float> scalar = cellGrid(s, 0.0f);
    blob(scalar, 1);
    const auto [low, high] = std::minmax_element(scalar.values.begin(), scalar.values.end());
    const float lowest = *low, highest = *high;
    AdvectionScratch scratch;
    const double dt = 1 / courantNumber(gas, 1);
    for (int n = 0; n < 30; ++n) advectScalar(scalar, gas, s, 1.0f, dt, scratch);
    for (const float value : scalar.values) {
      EXPECT_GE(value, lowest - 1e-5f);
      EXPECT_LE(value, highest + 1e-5f);
    }
  }
}

TEST(Advection, WhatIsLostFromTheBoxWentThroughItsFacesOrCameWithNewGas) {
  for (const AdvectionScheme& scheme :
       std::vector<AdvectionScheme>{DonorCell{0}, DonorCell{0.5}, DonorCell{1}, MacCormack{false}}) {
    FluidSettings s = box({16, 12, 14});
    s.advection = scheme;
    FluidState gas = gasIn(s);
    swirl(gas);
    Grid3<float> scalar = cellGrid(s, 0.0f);
    blob(scalar, 2);
    const auto content = [&] {
      double sum = 0;
      for (const float value : scalar.values) sum += double(value) - 2;
      return sum * s.cellSize * s.cellSize * s.cellSize;
    };
    AdvectionScratch scratch;
    Balance total;
    const double before = content();
    for (int n = 0; n < 10; ++n) total += advectScalar(scalar, gas, s, 2.0f, 0.01, scratch);
    total.gained = content() - before;
    EXPECT_GT(std::abs(total.out), 1e-4);
    EXPECT_LT(total.error(), 1e-4) << scheme.index();  // float rounding of 2688 cells
  }
}

TEST_P(AnyScheme, MirroredFlowGivesTheMirroredResult) {
  for (int axis = 0; axis < 3; ++axis) {
    FluidSettings s = box({10, 10, 10});
    s.advection = GetParam();
    FluidState gas = gasIn(s), mirror = gas;
    swirl(gas);
    blob(gas.temperature, 300);
    mirror.velocity = mirrored(gas.velocity, axis);
    mirror.temperature = mirrored(gas.temperature, axis);
    AdvectionScratch scratch;
    for (FluidState* g : {&gas, &mirror}) {
      advectScalar(g->temperature, *g, s, 300.0f, 0.02, scratch);
      advectVelocity(*g, s, 0.02, scratch);
    }
    EXPECT_LT(largestDifference(mirrored(mirror.temperature, axis).values, gas.temperature.values), 1e-4);
    for (int a = 0; a < 3; ++a)
      EXPECT_LT(
          largestDifference(mirrored(mirror.velocity, axis).component(a).values, gas.velocity.component(a).values),
          1e-6);
  }
}

/// Mean error of a blob carried by a uniform wind for a fixed time, at a Courant number.
double carriedBlobError(int n, const AdvectionScheme& scheme, double courant) {
  FluidSettings s = box({n, n, n});
  s.advection = scheme;
  FluidState gas = gasIn(s);
  const Vec3d wind{0.3, -0.2, 0.1};
  for (int axis = 0; axis < 3; ++axis)
    for (float& v : gas.velocity.component(axis).values) v = static_cast<float>(wind[axis]);
  Grid3<float> scalar = cellGrid(s, 0.0f);
  const auto at = [&](const Vec3d& p, double t) {
    const Vec3d d = p - Vec3d(.45, .55, .5) - wind * t;
    return std::exp(-dot(d, d) / 0.02);
  };
  setComponent(scalar, [&](const Vec3d& p) { return at(p, 0); });
  AdvectionScratch scratch;
  const double time = 0.25;
  const int steps = static_cast<int>(std::ceil(time * 0.6 * n / courant));
  for (int k = 0; k < steps; ++k) advectScalar(scalar, gas, s, 0.0f, time / steps, scratch);
  double sum = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) sum += std::abs(scalar(i, j, k) - at(scalar.position(i, j, k), time));
  return sum / (double(n) * n * n);
}

TEST(Advection, UpwindIsOfFirstOrderAndCentralAndMacCormackOfSecond) {
  const auto order = [](const AdvectionScheme& scheme) {
    return std::log2(carriedBlobError(24, scheme, 0.9) / carriedBlobError(48, scheme, 0.9));
  };
  EXPECT_NEAR(order(DonorCell{1}), 1, 0.3);
  EXPECT_NEAR(order(SemiLagrangian{}), 1, 0.3);
  EXPECT_NEAR(order(DonorCell{0}), 2, 0.3);
  EXPECT_NEAR(order(MacCormack{false}), 2, 0.3);
  EXPECT_NEAR(order(MacCormack{true}), 2, 0.5);  // peaks are clipped
}

TEST(Advection, WeightedDifferencesStayStableAtTheWholeCourantNumber) {
  for (const double weight : {0.0, 0.3, 0.7}) {
    FluidSettings s = box({16, 16, 16}, FaceKind::periodic);
    s.advection = DonorCell{weight};
    FluidState gas = gasIn(s);
    for (int axis = 0; axis < 3; ++axis)
      for (float& v : gas.velocity.component(axis).values) v = axis == 1 ? -1.0f : 1.0f;
    const Random random(1, Stream::test);
    Grid3<float> scalar = cellGrid(s, 0.0f);
    for (std::size_t n = 0; n < scalar.values.size(); ++n)
      scalar.values[n] = static_cast<float>(random.uniform(n) - .5);
    const auto energy = [&] {
      double sum = 0;
      for (const float value : scalar.values) sum += double(value) * value;
      return sum;
    };
    const double before = energy();
    AdvectionScratch scratch;
    for (int n = 0; n < 100; ++n) advectScalar(scalar, gas, s, 0, 1 / courantNumber(gas, 1), scratch);
    EXPECT_LE(energy(), before * (1 + 1e-4)) << weight;
  }
}

TEST(SemiLagrangian, CarriesByManyCellsAtOnceAndAroundAPeriodicBox) {
  for (const double cells : {5.0, -7.0, 21.0}) {
    FluidSettings s = box({12, 6, 6}, FaceKind::periodic);
    s.advection = SemiLagrangian{};
    FluidState gas = gasIn(s);
    for (float& u : gas.velocity.u.values) u = static_cast<float>(cells * s.cellSize);
    Grid3<float> scalar = cellGrid(s, 0.0f);
    setComponent(scalar, [](const Vec3d& p) { return std::sin(9 * p.x * p.x) + p.y; });
    const Grid3<float> before = scalar;
    AdvectionScratch scratch;
    carryScalar(scalar, gas, s, 0, 1, scratch);
    for (int i = 0; i < 12; ++i)
      EXPECT_NEAR(scalar(i, 2, 3), before((i + 48 - static_cast<int>(cells)) % 12, 2, 3), 1e-5);
  }
}

TEST(SemiLagrangian, TakesNothingFromBehindAThinWall) {
  FluidSettings s = box({12, 8, 8});
  s.advection = SemiLagrangian{};
  FluidState gas = gasIn(s);
  gas.solid.empty = false;
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j) gas.solid.openShare.u(6, j, k) = 0;
  // away from the wall on its right, along it, and towards it on its left, up to several cells a step
  setComponent(gas.velocity.u, [](const Vec3d& p) { return p.x < .5 ? .5 - p.x : 4 * (p.x - .5); });
  setComponent(gas.velocity.v, [](const Vec3d&) { return 0.7; });
  setComponent(gas.temperature, [](const Vec3d& p) { return p.x < .5 ? 1000.0 : 300.0; });
  AdvectionScratch scratch;
  for (int n = 0; n < 5; ++n) carryScalar(gas.temperature, gas, s, 300, 0.3, scratch);
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 6; i < 12; ++i) EXPECT_EQ(gas.temperature(i, j, k), 300);
}

TEST_P(AnyScheme, AWallIsNotCrossed) {
  FluidSettings s = box({12, 12, 12}, FaceKind::noSlip);
  s.advection = GetParam();
  FluidState gas = gasIn(s);
  setComponent(gas.velocity.v, [](const Vec3d& p) { return std::sin(pi * p.x); });
  setComponent(gas.temperature, [](const Vec3d& p) { return 300 + p.x; });
  restAtClosedFaces(gas);
  AdvectionScratch scratch;
  const Balance balance = advectScalar(gas.temperature, gas, s, 300.0f, 0.02, scratch);
  EXPECT_EQ(balance.out, 0);
  advectVelocity(gas, s, 0.02, scratch);
  for (int k = 0; k < 12; ++k)
    for (int i = 0; i < 12; ++i) {
      EXPECT_EQ(gas.velocity.v(i, 0, k), 0);
      EXPECT_EQ(gas.velocity.v(i, 12, k), 0);
    }
}

TEST_P(AnyScheme, AnyThreadsAndVectorWidthGiveTheSameBits) {
  FluidSettings s = box({19, 11, 9});
  s.advection = GetParam();
  std::vector<FluidState> results;
  for (const int threads : {1, 2})
    for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
      forceVectorPath(path);
      const ThreadLimit limit(threads);
      FluidState gas = gasIn(s);
      swirl(gas);
      blob(gas.temperature, 300);
      blob(gas.pressure, 0);
      AdvectionScratch scratch;
      advectScalar(gas.temperature, gas, s, 300.0f, 0.02, scratch);
      advectVelocity(gas, s, 0.02, scratch);
      results.push_back(gas);
    }
  for (const FluidState& result : results) {
    EXPECT_EQ(result.velocity, results[0].velocity);
    EXPECT_EQ(result.temperature, results[0].temperature);
  }
}

}  // namespace
}  // namespace brisance
