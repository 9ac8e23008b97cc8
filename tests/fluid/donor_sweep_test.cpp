#include "fluid/donor_sweep.h"

#include "base/parallel.h"
#include "base/random.h"
#include "base/vector_path.h"
#include "fluid/advection.h"
#include "fluid/fluid_fixture.h"
#include "fluid/forces.h"
#include "fluid/temperature.h"
#include "fluid/vorticity.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {
using namespace test;

constexpr double dt = 0.004, sootPerMass = 0.7;

FluidSettings forcedBox(const Faces& faces) {
  FluidSettings s = box({21, 18, 19});
  s.faces = faces;
  s.coolingRate = 2500;
  s.buoyancy = 0.02;
  s.force = {0.3, -0.2, 0.1};
  s.wind = {0.5, -0.4, 0.2};
  s.advection = DonorCell{0.8};
  s.vorticityConfinement = 0.7;
  return s;
}

void fillAtRandom(Grid3<float>& grid, float low, float high, std::uint64_t seed) {
  const Random random(seed, Stream::test);
  for (std::int64_t n = 0; n < grid.count(); ++n)
    grid.values[n] = low + (high - low) * static_cast<float>(random.uniform(static_cast<std::uint64_t>(n)));
}

/// Speeds of about 1, both signs on every face, joined where the box is periodic.
FluidState roughGas(const FluidSettings& s, bool solids) {
  const MovingSolid block{
      std::make_shared<const TriangleMesh>(boxMesh({.2, .3, .25}, false)), {{.5, .45, .5}, {}}, {}, {}};
  FluidState gas = solids ? gasIn(s, std::array{block}) : gasIn(s);
  for (int axis = 0; axis < 3; ++axis) {
    Grid3<float>& speed = gas.velocity.component(axis);
    fillAtRandom(speed, -1, 1, axis);
    const auto& open = gas.solid.openShare.component(axis).values;
    for (std::size_t n = 0; n < open.size(); ++n) speed.values[n] *= open[n] > 0 ? 1.0f : 0.0f;
    if (!isPeriodic(s.faces, axis)) continue;
    for (int k = 0; k < speed.size.z; ++k)
      for (int j = 0; j < speed.size.y; ++j)
        for (int i = 0; i < speed.size.x; ++i) {
          Vec3i from{i, j, k};
          if (from[axis] + 1 == speed.size[axis]) from[axis] = 0;
          speed(i, j, k) = speed(from.x, from.y, from.z);
        }
  }
  fillAtRandom(gas.temperature, 280, 2500, 4);
  fillAtRandom(gas.soot, 0, 1, 5);
  fillAtRandom(gas.flame, 0, 1, 6);
  fillAtRandom(gas.burnRate, 0, 3, 7);
  for (std::int64_t n = 0; n < gas.burnRate.count(); ++n) {
    if (gas.solid.inside.values[n]) gas.burnRate.values[n] = 0;
    gas.heatRate.values[n] = 1000 * gas.burnRate.values[n];
  }
  return gas;
}

std::vector<FluidSettings> allKindsOfBoxes() {
  using enum FaceKind;
  return {forcedBox(allFaces(open)), forcedBox(allFaces(periodic)),
          forcedBox({open, noSlip, freeSlip, open, noSlip, freeSlip}),
          forcedBox({periodic, periodic, noSlip, open, open, freeSlip})};
}

void expectSameFields(const FluidState& a, const FluidState& b, double speedTolerance) {
  EXPECT_LT(largestDifference(a.temperature.values, b.temperature.values), 2e-3);  // of 2500 K, a dozen roundings
  EXPECT_LT(largestDifference(a.soot.values, b.soot.values), 2e-6);
  EXPECT_LT(largestDifference(a.flame.values, b.flame.values), 2e-6);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_LT(largestDifference(a.velocity.component(axis).values, b.velocity.component(axis).values), speedTolerance);
}

/// What the sweeps do, by the steps of which they consist.
Balance stepOneAfterTheOther(FluidState& gas, const FluidSettings& s) {
  AdvectionScratch scratch;
  const double before = heatContent(gas, s);
  Balance heat = advectScalar(gas.temperature, gas, s, 300, dt, scratch);
  heat.in *= s.heatCapacity;
  heat.out *= s.heatCapacity;
  heat += heatAndCool(gas, s, dt);
  advectScalar(gas.soot, gas, s, 0, dt, scratch);
  advectScalar(gas.flame, gas, s, 0, dt, scratch);
  for (std::int64_t n = 0; n < gas.soot.count(); ++n) {
    const double burnt = dt * gas.burnRate.values[n];
    gas.soot.values[n] += static_cast<float>(sootPerMass * burnt);
    gas.flame.values[n] = static_cast<float>(gas.flame.values[n] * std::exp(-dt / s.flameLifetime) + burnt);
  }
  advectVelocity(gas, s, dt, scratch);
  addForces(gas, s, dt);
  heat.gained = heatContent(gas, s) - before;
  return heat;
}

/// Sweeps the gas, whose hottest cell must be found, and returns the balance.
Balance sweepOnce(FluidState& gas, const FluidSettings& s) {
  SweepScratch scratch;
  double hottest = 0;
  const Balance heat = sweepScalars(gas, s, {sootPerMass, s.flameLifetime}, dt, scratch, hottest);
  EXPECT_EQ(hottest, largestMagnitude(gas.temperature));
  sweepVelocity(gas, s, dt, scratch);
  return heat;
}

TEST(DonorSweep, DoesWhatTheStepsDoOneAfterTheOtherInEveryKindOfBox) {
  for (const FluidSettings& s : allKindsOfBoxes())
    for (const bool solids : {false, true}) {
      FluidState swept = roughGas(s, solids), stepped = swept;
      const Balance heat = sweepOnce(swept, s);
      const Balance expected = stepOneAfterTheOther(stepped, s);
      expectSameFields(swept, stepped, 2e-6);
      EXPECT_NEAR(heat.in / expected.in, 1, 1e-5);
      EXPECT_NEAR(heat.lost / expected.lost, 1, 1e-5);
      EXPECT_NEAR(heat.out, expected.out, 1e-5 * heat.in);
      EXPECT_NEAR(heat.gained, expected.gained, 1e-5 * heat.in);
    }
}

/// Gas as rough, but ambient outside a ball around a cell, across the faces of a periodic box.
FluidState ballOfGas(const FluidSettings& s, const Vec3i& middle) {
  FluidState gas = roughGas(s, false);
  for (int k = 0; k < s.cells.z; ++k)
    for (int j = 0; j < s.cells.y; ++j)
      for (int i = 0; i < s.cells.x; ++i) {
        const Vec3i cell{i, j, k};
        int squared = 0;
        for (int axis = 0; axis < 3; ++axis) {
          int away = std::abs(cell[axis] - middle[axis]);
          if (isPeriodic(s.faces, axis)) away = std::min(away, s.cells[axis] - away);
          squared += away * away;
        }
        if (squared <= 9) continue;
        gas.temperature(i, j, k) = 300;
        for (Grid3<float>* field : {&gas.soot, &gas.flame, &gas.burnRate, &gas.heatRate}) (*field)(i, j, k) = 0;
      }
  return gas;
}

TEST(DonorSweep, LeavesOutNothingOfABallOfGasWhereverItIs) {
  for (FluidSettings s : allKindsOfBoxes())
    for (const int width : {15, 37, 48}) {  // where several slabs of planes meet
      s.cells = {width, 9, 35};
      s.cellSize = 1.0 / 21;
      for (const Vec3i& middle : {Vec3i{0, 0, 0}, {width - 1, 8, 34}, {width / 2, 4, 15}, {18 % width, 7, 16}}) {
        FluidState swept = ballOfGas(s, middle), stepped = swept;
        const Balance heat = sweepOnce(swept, s);
        const Balance expected = stepOneAfterTheOther(stepped, s);
        expectSameFields(swept, stepped, 2e-6);
        const double heats = std::abs(expected.in) + std::abs(expected.gained);
        EXPECT_NEAR(heat.in, expected.in, 1e-5 * heats);
        EXPECT_NEAR(heat.out, expected.out, 1e-5 * heats);
        EXPECT_NEAR(heat.gained, expected.gained, 1e-5 * heats);
      }
    }
}

TEST(DonorSweep, TooLittleSootAndFlameAreNone) {
  const FluidSettings s = box({20, 8, 8});
  FluidState gas = gasIn(s);
  gas.velocity.u.values.assign(gas.velocity.u.values.size(), 1);
  gas.soot(5, 4, 4) = 3e-12f;
  gas.flame(5, 4, 4) = 1.0f;
  SweepScratch scratch;
  double hottest = 0;
  for (int step = 0; step < 100; ++step) {
    sweepScalars(gas, s, {sootPerMass, s.flameLifetime}, dt, scratch, hottest);
    for (const Grid3<float>* field : {&gas.soot, &gas.flame})
      for (const float density : field->values) ASSERT_TRUE(density == 0 || std::abs(density) >= 1e-12f) << density;
  }
  EXPECT_EQ(largestMagnitude(gas.soot), 0);
}

TEST(DonorSweep, HasTheSameBitsWithAnyVectorsAndThreads) {
  for (const FluidSettings& s : allKindsOfBoxes()) {
    const auto swept = [&](VectorPath path, int threads) {
      const ThreadLimit limit(threads);
      forceVectorPath(path);
      FluidState gas = roughGas(s, true);
      SweepScratch scratch;
      double hottest = 0;
      sweepScalars(gas, s, {sootPerMass, s.flameLifetime}, dt, scratch, hottest);
      sweepVelocity(gas, s, dt, scratch);
      confineVorticity(gas, s, dt, scratch.velocity);
      forceVectorPath(VectorPath::avx512);
      return gas;
    };
    const FluidState plain = swept(VectorPath::plain, 1);
    expectSameFields(plain, swept(VectorPath::avx2, 2), 1e-30);
    EXPECT_EQ(plain.velocity, swept(VectorPath::avx512, 2).velocity);
    EXPECT_EQ(plain.temperature, swept(VectorPath::avx512, 3).temperature);
  }
}

/// The force of Fedkiw, Stam & Jensen at one cell away from the faces, in double.
Vec3d forceAt(const MacVelocity& m, double h, int i, int j, int k) {
  const auto centre = [&](int a, int b, int c) {
    return Vec3d(m.u(a, b, c) + double(m.u(a + 1, b, c)), m.v(a, b, c) + double(m.v(a, b + 1, c)),
                 m.w(a, b, c) + double(m.w(a, b, c + 1))) *
           0.5;
  };
  const auto omega = [&](int a, int b, int c) {
    const Vec3d dx = centre(a + 1, b, c) - centre(a - 1, b, c), dy = centre(a, b + 1, c) - centre(a, b - 1, c),
                dz = centre(a, b, c + 1) - centre(a, b, c - 1);
    return Vec3d(dy.z - dz.y, dz.x - dx.z, dx.y - dy.x) / (2 * h);
  };
  const auto size = [&](int a, int b, int c) { return length(omega(a, b, c)); };
  const Vec3d gradient(size(i + 1, j, k) - size(i - 1, j, k), size(i, j + 1, k) - size(i, j - 1, k),
                       size(i, j, k + 1) - size(i, j, k - 1));
  return cross(normalized(gradient), omega(i, j, k));
}

TEST(Vorticity, TheForceIsThatOfItsDefinition) {
  const FluidSettings s = forcedBox(allFaces(FaceKind::open));
  const FluidState before = roughGas(s, false);
  FluidState gas = before;
  MacVelocity scratch;
  confineVorticity(gas, s, dt, scratch);
  const double strength = dt * s.vorticityConfinement * s.cellSize;
  for (int k = 3; k < s.cells.z - 3; ++k)
    for (int j = 3; j < s.cells.y - 3; ++j)
      for (int i = 3; i < s.cells.x - 3; ++i)
        for (int axis = 0; axis < 3; ++axis) {
          const Vec3i below = Vec3i(i, j, k) - Vec3i(axis == 0, axis == 1, axis == 2);
          const double force = forceAt(before.velocity, s.cellSize, i, j, k)[axis] +
                               forceAt(before.velocity, s.cellSize, below.x, below.y, below.z)[axis];
          const double gained =
              double(gas.velocity.component(axis)(i, j, k)) - before.velocity.component(axis)(i, j, k);
          EXPECT_NEAR(gained, 0.5 * strength * force, 1e-6);
        }
}

TEST(Vorticity, APeriodicBoxHasNoBeginning) {
  FluidSettings s = forcedBox(allFaces(FaceKind::periodic));
  s.cells = {12, 10, 11};
  const auto confined = [&](const Vec3i& shift) {
    FluidState gas = gasIn(s);
    for (int axis = 0; axis < 3; ++axis) {
      Grid3<float>& speed = gas.velocity.component(axis);
      const Random random(axis, Stream::test);
      for (int k = 0; k < speed.size.z; ++k)
        for (int j = 0; j < speed.size.y; ++j)
          for (int i = 0; i < speed.size.x; ++i) {
            const Vec3i at((i + shift.x) % s.cells.x, (j + shift.y) % s.cells.y, (k + shift.z) % s.cells.z);
            speed(i, j, k) = static_cast<float>(random.uniform(at.x + 100 * at.y + 10000 * at.z) - .5);
          }
    }
    MacVelocity scratch;
    confineVorticity(gas, s, dt, scratch);
    return gas.velocity;
  };
  const MacVelocity first = confined({0, 0, 0}), shifted = confined({5, 3, 7});
  for (int k = 0; k < s.cells.z; ++k)
    for (int j = 0; j < s.cells.y; ++j)
      for (int i = 0; i < s.cells.x; ++i)
        EXPECT_EQ(shifted.w(i, j, k), first.w((i + 5) % 12, (j + 3) % 10, (k + 7) % 11));
}

}  // namespace
}  // namespace brisance
