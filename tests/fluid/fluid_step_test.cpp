#include "fluid/fluid_step.h"

#include "fluid/advection.h"
#include "fluid/cooling.h"
#include "fluid/fluid_fixture.h"
#include "fluid/forces.h"
#include "fluid/temperature.h"
#include "fluid/vorticity.h"

namespace brisance {
namespace {
using namespace test;

TEST(Temperature, CoolingFollowsItsClosedForm) {
  // d theta/dt = -c (theta/R)^4 by many small explicit steps against the closed form in one.
  const double range = 2000, rate = 2500, start = 1800, time = 0.3;
  double theta = start;
  const int steps = 200000;
  for (int n = 0; n < steps; ++n) theta -= rate * std::pow(theta / range, 4) * time / steps;
  EXPECT_NEAR(cooled(start, range, rate, time), theta, 0.01);
  EXPECT_NEAR(cooled(cooled(start, range, rate, 0.1), range, rate, 0.2), cooled(start, range, rate, 0.3), 1e-9 * start);
}

TEST(Temperature, RowsCoolByTheClosedFormToTheRoundingOfSinglePrecision) {
  FluidSettings s;
  for (const double dt : {1e-5, 1e-3, 0.1, 10.0}) {
    const HeatRow row(s, dt);
    for (float T = 250; T < 6000; T += 7.3f) {
      const double above = double(T) - s.ambientTemperature, range = s.maximumTemperature - s.ambientTemperature;
      const double exact = s.ambientTemperature + cooled(above, range, s.coolingRate, dt);
      EXPECT_NEAR(row.cooled(T), exact, 4e-7 * exact) << T << " K, " << dt << " s";  // a few roundings of 6e-8
    }
  }
}

TEST(Temperature, GasBelowAmbientDoesNotCool) { EXPECT_EQ(cooled(-20, 2000, 2500, 1), -20); }

TEST(Temperature, ConductionKeepsHeatAndSpreadsAtItsRate) {
  FluidSettings s = box({24, 24, 24}, FaceKind::noSlip);
  s.conductivity = 0.01;
  FluidState gas = gasIn(s);
  setComponent(gas.temperature, [](const Vec3d& p) { return 300 + 100 * std::cos(pi * p.x); });
  const double before = heatContent(gas, s);
  const double dt = 0.01;
  for (int n = 0; n < 100; ++n) heatAndCool(gas, s, dt);
  EXPECT_NEAR(heatContent(gas, s), before, 1e-3 * s.heatCapacity);
  const double decay = std::exp(-s.conductivity * pi * pi * 1.0);
  EXPECT_NEAR((gas.temperature(0, 5, 5) - 300) / (100 * std::cos(pi / 48) * decay), 1, 2e-3);
}

TEST(WholeFluid, HeatReleasedIsGainedOrLost) {
  FluidSettings s = box({20, 20, 20});
  s.coolingRate = 2500;
  s.conductivity = 1e-3;
  s.buoyancy = 0.01;
  s.vorticityConfinement = 0.5;
  FluidState gas = gasIn(s);
  FluidScratch scratch;
  Balance heat, volume;
  for (int n = 0; n < 60; ++n) {
    setComponent(gas.heatRate, [](const Vec3d& p) { return length(p - Vec3d(.4, .5, .6)) < .2 ? 8000.0 : 0.0; });
    setComponent(gas.divergence, [](const Vec3d& p) { return length(p - Vec3d(.4, .5, .6)) < .2 ? 20.0 : 0.0; });
    const double dt = std::min(0.01, longestStep(gas, s, 20));
    const FluidReport report = stepFluid(gas, s, 1, dt, scratch);
    EXPECT_LE(report.courant, 1 + 1e-9);
    heat += report.heat;
    volume += report.volume;
  }
  EXPECT_GT(heat.in, 0);
  EXPECT_GT(heat.lost, 0.01 * heat.in);
  EXPECT_GT(heat.out, 0.01 * heat.in);
  EXPECT_LT(heat.error(), 1e-4);
  EXPECT_NEAR(volume.out / volume.in, 1, 1e-4);
}

TEST(WholeFluid, AVortexDecaysAtItsViscousRate) {
  // Taylor-Green in free-slip walls: u = sin(pi x) cos(pi y), v = -cos(pi x) sin(pi y) decays as exp(-2 pi^2 nu t).
  FluidSettings s = box({32, 32, 4}, FaceKind::freeSlip);
  s.advection = DonorCell{0};
  s.viscosity = 0.02;
  FluidState gas = gasIn(s);
  setComponent(gas.velocity.u, [](const Vec3d& p) { return std::sin(pi * p.x) * std::cos(pi * p.y); });
  setComponent(gas.velocity.v, [](const Vec3d& p) { return -std::cos(pi * p.x) * std::sin(pi * p.y); });
  const auto energy = [&] {
    double sum = 0;
    for (const float u : gas.velocity.u.values) sum += double(u) * u;
    return sum;
  };
  const double before = energy();
  FluidScratch scratch;
  const int steps = 200;
  for (int n = 0; n < steps; ++n) stepFluid(gas, s, 1, 0.0025, scratch);
  const double exact = std::exp(-4 * pi * pi * s.viscosity * steps * 0.0025);
  EXPECT_NEAR(energy() / before / exact, 1, 0.01);
}

const AdvectionScheme allSchemes[] = {DonorCell{1}, DonorCell{0}, MacCormack{}, SemiLagrangian{}};

/// A hot ball that expands, with everything that moves gas.
FluidSettings busyBox(const AdvectionScheme& scheme, FaceKind kind) {
  FluidSettings s = box({16, 16, 16}, kind);
  s.advection = scheme;
  s.buoyancy = 0.01;
  s.vorticityConfinement = 0.5;
  s.viscosity = s.conductivity = 2e-3;
  return s;
}
void heatBall(FluidState& gas, const Vec3d& centre) {
  const auto near = [&](const Vec3d& p) { return std::exp(-20 * dot(p - centre, p - centre)); };
  setComponent(gas.temperature, [&](const Vec3d& p) { return 300 + 600 * near(p); });
  setComponent(gas.divergence, [&](const Vec3d& p) { return 4 * near(p); });
}

TEST(WholeFluid, ASymmetricFireStaysSymmetric) {
  for (const AdvectionScheme& scheme : allSchemes)
    for (const FaceKind kind : {FaceKind::open, FaceKind::periodic}) {
      const FluidSettings s = busyBox(scheme, kind);
      FluidState gas = gasIn(s);
      heatBall(gas, {.5, .5, .5});
      if (kind == FaceKind::periodic) std::fill(gas.divergence.values.begin(), gas.divergence.values.end(), 0.0f);
      FluidScratch scratch;
      for (int n = 0; n < 10; ++n) stepFluid(gas, s, 1, std::min(0.02, longestStep(gas, s, 4)), scratch);
      for (const int axis : {0, 2}) {
        const MacVelocity mirror = mirrored(gas.velocity, axis);
        for (int a = 0; a < 3; ++a)
          EXPECT_LT(largestDifference(mirror.component(a).values, gas.velocity.component(a).values), 1e-4);
        EXPECT_LT(largestDifference(mirrored(gas.temperature, axis).values, gas.temperature.values), 0.01);
      }
      EXPECT_GT(largestMagnitude(gas.velocity.v), 0.1);
    }
}

/// A field seen from `shift` cells further along an axis of a periodic box.
Grid3<float> shifted(const Grid3<float>& grid, int axis, int shift, int period) {
  Grid3<float> out = grid;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        Vec3i at{i, j, k};
        at[axis] = (at[axis] + shift) % period;
        out(i, j, k) = grid(at.x, at.y, at.z);
      }
  return out;
}

TEST(WholeFluid, APeriodicBoxHasNoSeam) {
  for (const AdvectionScheme& scheme : allSchemes)
    for (int axis = 0; axis < 3; ++axis) {
      const FluidSettings s = busyBox(scheme, FaceKind::periodic);
      FluidState gas = gasIn(s);
      setComponent(gas.velocity.u, [](const Vec3d& p) { return .5 + std::sin(2 * pi * p.x) * std::cos(2 * pi * p.y); });
      setComponent(gas.velocity.v, [](const Vec3d& p) { return -std::cos(2 * pi * p.x) * std::sin(2 * pi * p.y); });
      setComponent(gas.velocity.w, [](const Vec3d& p) { return std::cos(2 * pi * p.x); });
      setComponent(gas.temperature, [](const Vec3d& p) { return 300 + 100 * std::sin(2 * pi * (p.x + p.y + p.z)); });
      FluidState moved = gas;
      const auto move = [&](FluidState& g) {
        for (int a = 0; a < 3; ++a) g.velocity.component(a) = shifted(g.velocity.component(a), axis, 5, 16);
        g.temperature = shifted(g.temperature, axis, 5, 16);
      };
      move(moved);
      FluidScratch scratch, other;
      for (int n = 0; n < 3; ++n) {
        stepFluid(gas, s, 1, 0.02, scratch);
        stepFluid(moved, s, 1, 0.02, other);
      }
      move(gas);
      for (int a = 0; a < 3; ++a)
        EXPECT_LT(largestDifference(gas.velocity.component(a).values, moved.velocity.component(a).values), 2e-4);
      EXPECT_LT(largestDifference(gas.temperature.values, moved.temperature.values), 0.01);
    }
}

TEST(WholeFluid, HotGasRises) {
  FluidSettings s = box({16, 16, 16});
  s.buoyancy = 0.03;
  FluidState gas = gasIn(s);
  setComponent(gas.temperature, [](const Vec3d& p) { return length(p - Vec3d(.5, .5, .5)) < .15 ? 900.0 : 300.0; });
  FluidScratch scratch;
  for (int n = 0; n < 5; ++n) stepFluid(gas, s, 1, 0.01, scratch);
  EXPECT_GT(gas.velocity.v(8, 8, 8), 0.05);
  EXPECT_NEAR(gas.velocity.u(8, 8, 8), 0, 1e-3);
}

TEST(Forces, ConfinementSpinsUpAVortexAndLeavesStillGasAlone) {
  FluidSettings s = box({16, 16, 16});
  s.vorticityConfinement = 1;
  FluidState still = gasIn(s);
  MacVelocity scratch;
  confineVorticity(still, s, 0.1, scratch);
  for (const float u : still.velocity.u.values) EXPECT_EQ(u, 0);
  FluidState gas = gasIn(s);
  const auto around = [](const Vec3d& p) {
    return std::exp(-20 * ((p.x - .5) * (p.x - .5) + (p.y - .5) * (p.y - .5)));
  };
  setComponent(gas.velocity.u, [&](const Vec3d& p) { return -(p.y - .5) * around(p); });
  setComponent(gas.velocity.v, [&](const Vec3d& p) { return (p.x - .5) * around(p); });
  const float before = gas.velocity.v(10, 8, 8);
  confineVorticity(gas, s, 0.1, scratch);
  EXPECT_GT(gas.velocity.v(10, 8, 8), before);
}

TEST(TimeStep, ObeysCourantNumberInEveryDirectionAndTheSource) {
  FluidSettings s = box({10, 10, 10});
  FluidState gas = gasIn(s);
  gas.velocity.u(5, 5, 5) = -3;  // the sign must not matter
  gas.velocity.v(5, 5, 5) = 2;
  gas.velocity.w(5, 5, 5) = -1;
  EXPECT_NEAR(longestStep(gas, s, 0), 0.1 / 6, 1e-12);
  EXPECT_NEAR(longestStep(gas, s, 1200), 6.0 / 1200, 1e-12);
}

TEST(Stability, TheFirstBadValueIsNamed) {
  FluidSettings s = box({6, 5, 4});
  FluidState gas = gasIn(s);
  EXPECT_EQ(findNotFinite(gas), "");
  gas.temperature(3, 2, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(findNotFinite(gas), "temperature at cell (3, 2, 1)");
}

TEST(FluidStep, TooLittleSootAndFlameAreNoneByEveryScheme) {
  for (const AdvectionScheme& scheme : {AdvectionScheme{DonorCell{}}, AdvectionScheme{DonorCell{0.1}},
                                        AdvectionScheme{MacCormack{}}, AdvectionScheme{SemiLagrangian{}}}) {
    FluidSettings s = box({24, 12, 12});
    s.advection = scheme;
    s.wind = {1, 0, 0};
    FluidState gas = gasIn(s);
    gas.velocity.u.values.assign(gas.velocity.u.values.size(), 1);
    gas.soot(12, 6, 6) = 1;
    gas.flame(12, 6, 6) = 1;
    FluidScratch scratch;
    for (int step = 0; step < 6; ++step) {
      stepFluid(gas, s, 1, 0.6 * s.cellSize, scratch, limitsOf(gas));
      for (const Grid3<float>* field : {&gas.soot, &gas.flame})
        for (const float density : field->values) ASSERT_TRUE(density == 0 || std::abs(density) >= 1e-12f) << density;
    }
    EXPECT_GT(largestMagnitude(gas.soot), 0.01);
  }
}

}  // namespace
}  // namespace brisance
