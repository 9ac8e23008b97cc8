#include "fluid/diffusion.h"

#include "base/parallel.h"
#include "base/random.h"
#include "base/vector_path.h"
#include "fluid/fluid_fixture.h"
#include "fluid/forces.h"
#include "fluid/temperature.h"

namespace brisance {
namespace {
using namespace test;

/// Amplitude left of a wave of viscous gas, cos(2 pi x) along y in a periodic box, after `steps` of dt [s].
double waveLeft(double viscosity, double dt, int steps) {
  FluidSettings s = box({64, 4, 4}, FaceKind::periodic);
  s.viscosity = viscosity;
  FluidState gas = gasIn(s);
  setComponent(gas.velocity.v, [](const Vec3d& p) { return std::cos(2 * pi * p.x); });
  const float before = gas.velocity.v(0, 2, 1);
  for (int n = 0; n < steps; ++n) diffuseVelocity(gas, s, dt);
  return gas.velocity.v(0, 2, 1) / before;
}

TEST(Diffusion, AWaveDecaysAtItsRateExplicitlyAndImplicitly) {
  const double rate = 4 * pi * pi * 0.1, time = 0.2;
  // k dt / h^2 is 0.2 and 4.1; backward Euler's error is rate^2 dt time / 2 of the amplitude, explicit Euler's its
  // negative.
  for (const int steps : {410, 20}) {
    const double dt = time / steps, share = waveLeft(0.1, dt, steps) / std::exp(-rate * time);
    EXPECT_NEAR(share, 1 + (steps == 20 ? 1 : -1) * rate * rate * dt * time / 2, 0.003) << steps;
  }
}

TEST(Diffusion, AStepAThousandTimesTooLongForExplicitOnesOnlySmooths) {
  for (const FaceKind kind : {FaceKind::open, FaceKind::noSlip, FaceKind::freeSlip, FaceKind::periodic}) {
    FluidSettings s = box({12, 10, 14}, kind);
    s.viscosity = s.conductivity = 10;
    FluidState gas = gasIn(s);
    EXPECT_EQ(longestStep(gas, s, 0), HUGE_VAL);
    const Random random(1, Stream::test);
    for (std::size_t n = 0; n < gas.temperature.values.size(); ++n)
      gas.temperature.values[n] = static_cast<float>(300 + 100 * random.uniform(n));
    setComponent(gas.velocity.v, [](const Vec3d& p) { return p.x > .4 && p.x < .6 ? 1.0 : 0.0; });
    restAtClosedFaces(gas);
    const double heat = heatContent(gas, s);
    diffuseVelocity(gas, s, 1);
    conduct(gas, s, 1);
    EXPECT_NEAR(heatContent(gas, s) / heat, 1, 1e-5);
    const auto [coldest, hottest] = std::minmax_element(gas.temperature.values.begin(), gas.temperature.values.end());
    EXPECT_LT(*hottest - *coldest, 0.1);
    for (const float speed : gas.velocity.v.values) {
      EXPECT_GE(speed, -1e-6);
      EXPECT_LE(speed, 0.4f);
    }
  }
}

TEST(Diffusion, HeatStaysOnItsSideOfAWall) {
  FluidSettings s = box({10, 6, 6}, FaceKind::noSlip);
  s.conductivity = 1;
  FluidState gas = gasIn(s);
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 6; ++j) gas.solid.openShare.u(4, j, k) = 0;
  setComponent(gas.temperature, [](const Vec3d& p) { return p.x < .4 ? 400 + 100 * p.x : 300.0; });
  conduct(gas, s, 1);
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(gas.temperature(i, 3, 3), i < 4 ? 420 : 300, 0.5) << i;
}

TEST(Diffusion, BetweenAWallAtRestAndAMovingOneTheSpeedIsLinear) {
  for (int axis = 0; axis < 3; ++axis)  // across
    for (const double lid : {2.0, -2.0}) {
      const int along = (axis + 1) % 3;
      FluidSettings s = box({8, 8, 8}, FaceKind::periodic);
      s.faces[lowerFaceOf(axis)] = s.faces[upperFaceOf(axis)] = FaceKind::noSlip;
      s.wallVelocity[upperFaceOf(axis)][along] = lid;
      s.viscosity = 0.5;
      FluidState gas = gasIn(s);
      FluidScratch scratch;
      for (int n = 0; n < 100; ++n) stepFluid(gas, s, 1, 0.1, scratch);
      const Grid3<float>& speed = gas.velocity.component(along);
      for (int n = 0; n < 8; ++n) {
        Vec3i at{3, 4, 5};
        at[axis] = n;
        EXPECT_NEAR(speed(at.x, at.y, at.z), lid * (n + 0.5) / 8, 1e-4);
      }
    }
}

TEST(Diffusion, MirroredGasDiffusesToTheMirroredResult) {
  for (const double viscosity : {0.01, 1.0})
    for (int axis = 0; axis < 3; ++axis) {
      FluidSettings s = box({10, 10, 10}, FaceKind::noSlip), other = s;
      s.viscosity = other.viscosity = viscosity;
      s.wallVelocity[2] = {1, 0, 0.5};
      other.wallVelocity = s.wallVelocity;
      std::swap(other.wallVelocity[lowerFaceOf(axis)], other.wallVelocity[upperFaceOf(axis)]);
      for (Vec3d& wall : other.wallVelocity) wall[axis] = -wall[axis];
      FluidState gas = gasIn(s), mirror = gas;
      setComponent(gas.velocity.u, [](const Vec3d& p) { return std::sin(5 * p.x) * p.z; });
      setComponent(gas.velocity.w, [](const Vec3d& p) { return p.x * p.y; });
      mirror.velocity = mirrored(gas.velocity, axis);
      diffuseVelocity(gas, s, 0.05);
      diffuseVelocity(mirror, other, 0.05);
      for (int a = 0; a < 3; ++a)
        EXPECT_LT(
            largestDifference(mirrored(mirror.velocity, axis).component(a).values, gas.velocity.component(a).values),
            1e-6);
    }
}

TEST(Diffusion, AnyThreadsAndVectorWidthGiveTheSameBits) {
  std::vector<FluidState> results;
  for (const int threads : {1, 2})
    for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
      forceVectorPath(path);
      const ThreadLimit limit(threads);
      FluidSettings s = box({19, 11, 9}, FaceKind::noSlip);
      s.faces[4] = s.faces[5] = FaceKind::periodic;
      FluidState gas = gasIn(s);
      setComponent(gas.velocity.u, [](const Vec3d& p) { return std::sin(7 * p.y) + p.x; });
      setComponent(gas.temperature, [](const Vec3d& p) { return 300 + 50 * std::cos(9 * p.z * p.x); });
      for (const double k : {0.05, 5.0}) {
        s.viscosity = s.conductivity = k;
        diffuseVelocity(gas, s, 0.01);
        conduct(gas, s, 0.01);
      }
      results.push_back(gas);
    }
  for (const FluidState& result : results) {
    EXPECT_EQ(result.velocity, results[0].velocity);
    EXPECT_EQ(result.temperature, results[0].temperature);
  }
}

TEST(Stirring, GasInsideTheCylinderComesToTurnAndOutsideIsLeftAlone) {
  FluidSettings s = box({20, 20, 20});
  Stirring stirring{{.5, .5, .5}, {0, 0, 2}, 0.3, 0.4, 3, 0.1};
  s.stirring = {stirring};
  FluidState gas = gasIn(s);
  stir(gas, s, 0.1);
  // A third of the way from rest, 1/e, is left; at (0.725, 0.5) the solid moves at 3 * 0.225 along y.
  EXPECT_NEAR(gas.velocity.v(14, 10, 10), (1 - std::exp(-1)) * 3 * 0.225, 1e-6);
  EXPECT_NEAR(gas.velocity.u(10, 14, 10), -(1 - std::exp(-1)) * 3 * 0.225, 1e-6);
  EXPECT_EQ(gas.velocity.v(18, 10, 10), 0);  // beyond the radius
  EXPECT_EQ(gas.velocity.v(14, 10, 15), 0);  // beyond the length
  for (const float w : gas.velocity.w.values) EXPECT_EQ(w, 0);
}

TEST(Stirring, KeepsTheGasOfAClosedBoxCircling) {
  FluidSettings s = box({20, 6, 20}, FaceKind::noSlip);
  s.advection = MacCormack{};
  s.viscosity = 1e-3;
  s.stirring = {{{.5, .15, .5}, {0, 1, 0}, 0.25, {}, 4, 0.1}};
  FluidState gas = gasIn(s);
  FluidScratch scratch;
  for (int n = 0; n < 200; ++n) stepFluid(gas, s, 1, std::min(0.02, longestStep(gas, s, 0)), scratch);
  const float turning = gas.velocity.w(14, 3, 10);
  EXPECT_LT(turning, -0.5);  // counter-clockwise seen from above: at +x towards -z
  EXPECT_NEAR(gas.velocity.w(5, 3, 10), -turning, 0.02);
  EXPECT_NEAR(gas.velocity.u(10, 3, 5), turning, 0.02);
}

}  // namespace
}  // namespace brisance
