#include "fluid/pressure.h"

#include "base/parallel.h"
#include "base/random.h"
#include "base/vector_path.h"
#include "fluid/fluid_fixture.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {
using namespace test;

MovingSolid boxAt(const Vec3d& centre, const Vec3d& size) {
  return {std::make_shared<const TriangleMesh>(boxMesh(size, false)), {centre, {}}, {}, {}};
}

void randomVelocity(FluidState& gas) {
  const Random random(3, Stream::test);
  std::uint64_t index = 0;
  for (int axis = 0; axis < 3; ++axis) {
    auto& grid = gas.velocity.component(axis);
    const auto& open = gas.solid.openShare.component(axis);
    for (std::size_t n = 0; n < grid.values.size(); ++n)
      grid.values[n] = open.values[n] > 0 ? static_cast<float>(random.normal(index++)) : 0.0f;
  }
}

TEST(Projection, LeavesAUniformFlowAlone) {
  for (const double sign : {1.0, -1.0}) {
    FluidSettings s = box({10, 12, 9});
    FluidState gas = gasIn(s);
    for (int axis = 0; axis < 3; ++axis)
      for (float& v : gas.velocity.component(axis).values) v = static_cast<float>(sign * (axis + 0.5));
    const MacVelocity before = gas.velocity;
    PressureScratch scratch;
    project(gas, s, 0.1, scratch);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LT(largestDifference(gas.velocity.component(axis).values, before.component(axis).values), 1e-6);
  }
}

TEST(Projection, TheDivergenceEqualsItsSourceToTheTolerance) {
  FluidSettings s = box({20, 16, 18});
  s.faces[2] = FaceKind::noSlip;  // a floor
  s.pressure = ConjugateGradient{1e-6, 4000};
  FluidState gas = gasIn(s);
  randomVelocity(gas);
  setComponent(gas.divergence, [](const Vec3d& p) { return p.x > .4 && p.x < .6 && p.y < .5 ? 30.0 : 0.0; });
  PressureScratch scratch;
  const PressureReport report = project(gas, s, 0.05, scratch);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.residual, 1e-6);
  EXPECT_LT(divergenceError(gas), 1e-4);  // float velocities of about 1 over cells of 0.05 against a source of 30
  EXPECT_NEAR(outwardVolume(gas, s) / createdVolume(gas), 1, 1e-4);
}

/// Largest error of the pressure of a manufactured solution p = sin(pi x) sin(2 pi y) sin(pi z), zero on the open
/// faces.
double manufacturedError(int n) {
  FluidSettings s = box({n, n, n});
  s.pressure = ConjugateGradient{1e-10, 4000};
  const PressureOperator op = makePressureOperator(stampSolids(s, {}), s.faces);
  const Vec3i padded{n + 2, n + 2, n + 2};
  ConjugateGradientScratch scratch;
  for (Grid3<double>* v : {&scratch.x, &scratch.r, &scratch.d, &scratch.q})
    *v = Grid3<double>(padded, {}, s.cellSize, 0.0);
  const auto exact = [&](int i, int j, int k) {
    const double h = s.cellSize;
    return std::sin(pi * (i + .5) * h) * std::sin(2 * pi * (j + .5) * h) * std::sin(pi * (k + .5) * h);
  };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        scratch.r(i + 1, j + 1, k + 1) = 6 * pi * pi * s.cellSize * s.cellSize * exact(i, j, k);
  solveConjugateGradient(op, std::get<ConjugateGradient>(s.pressure), scratch);
  double largest = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        largest = std::max(largest, std::abs(scratch.x(i + 1, j + 1, k + 1) - exact(i, j, k)));
  return largest;
}

TEST(Projection, AManufacturedSolutionConvergesAtSecondOrder) {
  EXPECT_NEAR(std::log2(manufacturedError(12) / manufacturedError(24)), 2, 0.1);
}

TEST(Projection, AHydrostaticColumnStaysAtRest) {
  FluidSettings s = box({8, 16, 8}, FaceKind::freeSlip);
  s.force = {0, -9.81, 0};
  FluidState gas = gasIn(s);
  FluidScratch scratch;
  for (int n = 0; n < 5; ++n) stepFluid(gas, s, 1, 0.01, scratch);
  for (int axis = 0; axis < 3; ++axis)
    for (const float speed : gas.velocity.component(axis).values) EXPECT_NEAR(speed, 0, 1e-6);
}

TEST(Projection, MirroredGasGivesTheMirroredResult) {
  for (int axis = 0; axis < 3; ++axis) {
    FluidSettings s = box({12, 12, 12});
    s.pressure = ConjugateGradient{1e-9, 4000};
    FluidState gas = gasIn(s), mirror = gas;
    randomVelocity(gas);
    setComponent(gas.divergence, [](const Vec3d& p) { return p.x < .3 && p.y > .5 && p.z < .8 ? 5.0 : 0.0; });
    mirror.velocity = mirrored(gas.velocity, axis);
    mirror.divergence = mirrored(gas.divergence, axis);
    PressureScratch scratch, other;
    project(gas, s, 0.1, scratch);
    project(mirror, s, 0.1, other);
    for (int a = 0; a < 3; ++a)
      EXPECT_LT(
          largestDifference(mirrored(mirror.velocity, axis).component(a).values, gas.velocity.component(a).values),
          2e-6);
  }
}

TEST(Projection, ASealedPocketWithASourceIsReportedOrItsMeanRemoved) {
  FluidSettings s = box({12, 12, 12}, FaceKind::noSlip);
  FluidState gas = gasIn(s);
  gas.divergence(5, 5, 5) = 10;
  PressureScratch scratch;
  EXPECT_THROW(project(gas, s, 0.1, scratch), InputError);
  s.removeMeanSource = true;
  EXPECT_TRUE(project(gas, s, 0.1, scratch).converged);
  EXPECT_NEAR(outwardVolume(gas, s), 0, 1e-9);
}

TEST(Projection, AHollowBoxInOpenAirIsFoundSealed) {
  FluidSettings s = box({16, 16, 16});
  const MovingSolid outer = boxAt({.5, .5, .5}, {.6, .6, .6}), inner = boxAt({.5, .5, .5}, {.45, .45, .45});
  const MovingSolid shell[] = {outer};
  const SolidStamp solid = stampSolids(s, shell);
  EXPECT_EQ(solid.inside(8, 8, 8), 1);
  EXPECT_EQ(solid.inside(1, 8, 8), 0);
  EXPECT_EQ(solid.pocketCount(), 0);
  TriangleMesh hollow = *outer.mesh;
  const auto base = static_cast<std::uint32_t>(hollow.vertices.size());
  hollow.vertices.insert(hollow.vertices.end(), inner.mesh->vertices.begin(), inner.mesh->vertices.end());
  for (const Triangle& t : inner.mesh->triangles) hollow.triangles.push_back({t[0] + base, t[2] + base, t[1] + base});
  const MovingSolid head[] = {{std::make_shared<const TriangleMesh>(hollow), {{.5, .5, .5}, {}}, {}, {}}};
  const SolidStamp sealed = stampSolids(s, head);
  EXPECT_EQ(sealed.pocketCount(), 1);
  EXPECT_TRUE(sealed.sealed[sealed.region(8, 8, 8)]);
  EXPECT_FALSE(sealed.sealed[sealed.region(0, 0, 0)]);
}

TEST(Solids, AWallThinnerThanACellBlocksAndAnOpeningLetsThrough) {
  for (int axis = 0; axis < 3; ++axis) {
    FluidSettings s = box({16, 16, 16});
    Vec3d size{1.2, 1.2, 1.2};
    size[axis] = 0.1 / 16;
    Vec3d place{.5, .5, .5};
    place[axis] = 0.53;
    s.pressure = AutomaticSolver{1e-7};
    const MovingSolid wall[] = {boxAt(place, size)};
    FluidState gas = gasIn(s, wall);
    gas.divergence(axis == 0 ? 2 : 8, axis == 1 ? 2 : 8, axis == 2 ? 2 : 8) = 50;
    PressureScratch scratch;
    project(gas, s, 0.1, scratch);
    double beyond = 0;
    const Grid3<float>& speed = gas.velocity.component(axis);
    for (int k = 0; k < speed.size.z; ++k)
      for (int j = 0; j < speed.size.y; ++j)
        for (int i = 0; i < speed.size.x; ++i)
          if ((axis == 0 ? i : axis == 1 ? j : k) == 16) beyond += std::abs(speed(i, j, k));
    EXPECT_LT(beyond, 1e-6) << axis;
    EXPECT_NEAR(outwardVolume(gas, s) / createdVolume(gas), 1, 1e-4);
  }
}

TEST(Projection, AnyThreadsAndVectorWidthGiveTheSameBits) {
  FluidSettings s = box({17, 13, 15});
  std::vector<FluidState> results;
  for (const int threads : {1, 2})
    for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
      const ThreadLimit limit(threads);
      forceVectorPath(path);
      FluidState gas = gasIn(s);
      randomVelocity(gas);
      PressureScratch scratch;
      project(gas, s, 0.1, scratch);
      results.push_back(gas);
    }
  for (const FluidState& result : results) {
    EXPECT_EQ(result.velocity, results[0].velocity);
    EXPECT_EQ(result.pressure, results[0].pressure);
  }
}

}  // namespace
}  // namespace brisance
