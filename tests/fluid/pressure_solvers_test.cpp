// Every pressure solver by name, with solids and without.
#include "base/parallel.h"
#include "base/random.h"
#include "base/vector_path.h"
#include "fluid/fluid_fixture.h"
#include "fluid/multigrid.h"
#include "fluid/projection.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {
using namespace test;

const PressureSolver fastSolvers[] = {AutomaticSolver{1e-5}, FastPoisson{1e-5}, MultigridSolver{1e-5}};

MovingSolid solidAt(const Vec3d& centre, const TriangleMesh& mesh) {
  return {std::make_shared<const TriangleMesh>(mesh), {centre, {}}, {}, {}};
}

/// A ball, a block on the floor and a pane a tenth of a cell thick.
std::vector<MovingSolid> threeSolids() {
  return {solidAt({.3, .6, .55}, sphereMesh(.17, 16)), solidAt({.7, .2, .3}, boxMesh({.2, .4, .3}, false)),
          solidAt({.72, .7, .5}, boxMesh({.005, .4, .5}, false))};
}

/// Random speeds on open faces, the two that are one in a periodic box alike.
void stirAtRandom(FluidState& gas, const Faces& faces) {
  const Random random(7, Stream::test);
  std::uint64_t index = 0;
  for (int axis = 0; axis < 3; ++axis) {
    Grid3<float>& speed = gas.velocity.component(axis);
    const Grid3<float>& open = gas.solid.openShare.component(axis);
    for (int k = 0; k < speed.size.z; ++k)
      for (int j = 0; j < speed.size.y; ++j)
        for (int i = 0; i < speed.size.x; ++i)
          speed(i, j, k) = open(i, j, k) > 0 ? static_cast<float>(random.normal(index++)) : 0.0f;
    if (!isPeriodic(faces, axis)) continue;
    for (int k = 0; k < speed.size.z; ++k)
      for (int j = 0; j < speed.size.y; ++j)
        for (int i = 0; i < speed.size.x; ++i) {
          const int last = speed.size[axis] - 1;
          if (axis == 0 && i == last) speed(i, j, k) = speed(0, j, k);
          if (axis == 1 && j == last) speed(i, j, k) = speed(i, 0, k);
          if (axis == 2 && k == last) speed(i, j, k) = speed(i, j, 0);
        }
  }
}

void addSource(FluidState& gas) {
  setComponent(gas.divergence, [](const Vec3d& p) { return p.x > .4 && p.x < .6 && p.y > .6 ? 30.0 : 0.0; });
  for (std::size_t n = 0; n < gas.divergence.values.size(); ++n)
    if (gas.solid.inside.values[n]) gas.divergence.values[n] = 0;
}

FluidState stirredGas(const FluidSettings& s, std::span<const MovingSolid> solids) {
  FluidState gas = gasIn(s, solids);
  stirAtRandom(gas, s.faces);
  addSource(gas);
  return gas;
}

/// A smooth function with the values or slopes that the ends of an axis ask for, and its second derivative's factor.
struct SmoothMode {
  double value, curvature;
};
SmoothMode smoothMode(AxisEnds ends, double x) {
  switch (ends) {
    case AxisEnds::walls:
      return {std::cos(2 * pi * x), 4 * pi * pi};
    case AxisEnds::open:
      return {std::sin(pi * x), pi * pi};
    case AxisEnds::wallThenOpen:
      return {std::cos(pi * x / 2), pi * pi / 4};
    case AxisEnds::openThenWall:
      return {std::sin(pi * x / 2), pi * pi / 4};
    default:
      return {std::sin(2 * pi * x), 4 * pi * pi};
  }
}

std::array<FaceKind, 2> facesOf(AxisEnds ends) {
  const FaceKind open = FaceKind::open, wall = FaceKind::noSlip, periodic = FaceKind::periodic;
  switch (ends) {
    case AxisEnds::walls:
      return {wall, wall};
    case AxisEnds::open:
      return {open, open};
    case AxisEnds::wallThenOpen:
      return {wall, open};
    case AxisEnds::openThenWall:
      return {open, wall};
    default:
      return {periodic, periodic};
  }
}

/// Largest error of the direct solution for a manufactured one.
double manufacturedError(const std::array<AxisEnds, 3>& ends, int n) {
  Faces faces;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) faces[2 * axis + side] = facesOf(ends[axis])[side];
  const BoxPoisson box({n, n, n}, faces);
  CellField field(box.layout());
  const double h = 1.0 / n;
  double curvature = 0;
  const auto exact = [&](int i, int j, int k) {
    const SmoothMode modes[] = {smoothMode(ends[0], (i + .5) * h), smoothMode(ends[1], (j + .5) * h),
                                smoothMode(ends[2], (k + .5) * h)};
    curvature = (modes[0].curvature + modes[1].curvature) + modes[2].curvature;
    return modes[0].value * modes[1].value * modes[2].value;
  };
  const auto forCells = [&](const auto& visit) {
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) visit(i, j, k);
  };
  forCells([&](int i, int j, int k) {
    const double p = exact(i, j, k);
    field(i, j, k) = static_cast<float>(h * h * curvature * p);
  });
  box.solve(field);
  double largest = 0;
  forCells([&](int i, int j, int k) { largest = std::max(largest, std::abs(field(i, j, k) - exact(i, j, k))); });
  return largest;
}

TEST(FastPoisson, AManufacturedSolutionConvergesAtSecondOrderForEveryMixOfFaces) {
  const AxisEnds all[] = {AxisEnds::walls, AxisEnds::open, AxisEnds::wallThenOpen, AxisEnds::openThenWall,
                          AxisEnds::periodic};
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z : {x, (x + y) % 5}) {
        const std::array<AxisEnds, 3> ends{all[x], all[y], all[z]};
        EXPECT_NEAR(std::log2(manufacturedError(ends, 10) / manufacturedError(ends, 20)), 2, 0.15)
            << x << " " << y << " " << z;
      }
}

TEST(PressureSolvers, EachReachesItsToleranceWithSolidsAndWithout) {
  const std::vector<MovingSolid> solids = threeSolids();
  for (const PressureSolver& solver : fastSolvers)
    for (const bool withSolids : {false, true})
      for (const FaceKind floor : {FaceKind::open, FaceKind::freeSlip}) {
        FluidSettings s = box({20, 18, 21});
        s.faces[2] = floor;
        s.pressure = solver;
        FluidState gas = stirredGas(s, withSolids ? std::span(solids) : std::span<MovingSolid>());
        CellField b{CellLayout(s.cells)};
        const double before = computeSource(gas, b).source;
        PressureScratch scratch;
        const PressureReport report = project(gas, s, 0.05, scratch);
        EXPECT_TRUE(report.converged);
        EXPECT_LE(computeSource(gas, b).source / before, 1e-5);
        EXPECT_NEAR(outwardVolume(gas, s) / createdVolume(gas), 1, 1e-4);
      }
}

TEST(PressureSolvers, MultigridGoesOnWhereAutoLosesPatience) {
  const std::vector<MovingSolid> solids = threeSolids();
  FluidSettings s = box({20, 18, 21});
  CellField b{CellLayout(s.cells)};
  std::vector<FluidState> results;
  for (const int patience : {1, 3, 1000}) {
    s.pressure = AutomaticSolver{1e-5, patience};
    FluidState gas = stirredGas(s, solids);
    const double before = computeSource(gas, b).source;
    PressureScratch scratch;
    const PressureReport report = project(gas, s, 0.05, scratch);
    const double left = computeSource(gas, b).source / before;
    EXPECT_TRUE(report.converged) << patience;
    EXPECT_LE(left, 1e-5) << patience;
    EXPECT_NEAR(report.residual / left, 1, 0.01) << patience;
    EXPECT_GT(report.iterations, std::min(patience, 3)) << patience;
    s.pressure = FastPoisson{1e-5, patience};
    gas = stirredGas(s, solids);
    EXPECT_EQ(project(gas, s, 0.05, scratch).converged, patience == 1000);  // alone, it needs more than 3
    s.pressure = AutomaticSolver{1e-5, patience};
    results.push_back(stirredGas(s, solids));
    project(results.back(), s, 0.05, scratch);
  }
  for (const FluidState& gas : results) {  // the pressure is the sum of what both found
    EXPECT_LT(largestDifference(gas.pressure.values, results.back().pressure.values), 1e-3);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LT(largestDifference(gas.velocity.component(axis).values, results.back().velocity.component(axis).values),
                1e-3);
  }
}

TEST(PressureSolvers, AllFindTheSamePressure) {
  const std::vector<MovingSolid> solids = threeSolids();
  FluidSettings s = box({20, 18, 21});
  s.pressure = ConjugateGradient{1e-10, 4000};
  FluidState exact = stirredGas(s, solids);
  PressureScratch scratch;
  project(exact, s, 0.05, scratch);
  for (const PressureSolver& solver : fastSolvers) {
    s.pressure = solver;
    FluidState gas = stirredGas(s, solids);
    project(gas, s, 0.05, scratch);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LT(largestDifference(gas.velocity.component(axis).values, exact.velocity.component(axis).values), 1e-3);
    EXPECT_LT(largestDifference(gas.pressure.values, exact.pressure.values), 1e-3);
  }
}

/// |b - A x| / |b| in double precision.
double trueResidual(const PressureOperator& op, const CellField& b, const CellField& x) {
  double wrong = 0, all = 0;
  for (int k = 0; k < op.cells.z; ++k)
    for (int j = 0; j < op.cells.y; ++j)
      for (int i = 0; i < op.cells.x; ++i) {
        const double here = x(i, j, k);
        const double image =
            op.share.u(i, j, k) * (here - x(i - 1, j, k)) + op.share.u(i + 1, j, k) * (here - x(i + 1, j, k)) +
            op.share.v(i, j, k) * (here - x(i, j - 1, k)) + op.share.v(i, j + 1, k) * (here - x(i, j + 1, k)) +
            op.share.w(i, j, k) * (here - x(i, j, k - 1)) + op.share.w(i, j, k + 1) * (here - x(i, j, k + 1));
        wrong += (b(i, j, k) - image) * (b(i, j, k) - image);
        all += double(b(i, j, k)) * b(i, j, k);
      }
  return std::sqrt(wrong / all);
}

TEST(PressureSolvers, WhatTheyClaimAmongSolidsIsTrue) {
  const FluidSettings s = box({24, 24, 24});
  const std::vector<MovingSolid> solids = threeSolids();
  const FluidState gas = stirredGas(s, solids);
  const PressureOperator op = makePressureOperator(gas.solid, s.faces);
  const BoxPoisson box(s.cells, s.faces);
  const SolidFaces surface = findSurface(gas.solid, box);
  CellField b(box.layout()), work(box.layout());
  computeSource(gas, b);
  SurfaceVectors vectors;
  Multigrid multigrid(gas.solid, s.faces);
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    constexpr double rounding = 2e-5;  // of a solution in single precision on 24 cells
    CellField x = b;
    const PressureReport fast = solveFastPoisson(box, surface, tolerance, 100, x, work, vectors);
    EXPECT_TRUE(fast.converged);
    EXPECT_LE(trueResidual(op, b, x), tolerance + rounding);
    x = b;
    EXPECT_TRUE(multigrid.solve(x, tolerance, 100).converged);
    EXPECT_LE(trueResidual(op, b, x), tolerance + rounding);
  }
}

TEST(PressureSolvers, AUniformFlowStays) {
  for (const PressureSolver& solver : fastSolvers)
    for (const double sign : {1.0, -1.0}) {
      FluidSettings s = box({10, 12, 9});
      s.pressure = solver;
      FluidState gas = gasIn(s);
      for (int axis = 0; axis < 3; ++axis)
        for (float& v : gas.velocity.component(axis).values) v = static_cast<float>(sign * (axis + 0.5));
      const MacVelocity before = gas.velocity;
      PressureScratch scratch;
      project(gas, s, 0.1, scratch);
      EXPECT_EQ(gas.velocity, before);
    }
}

TEST(PressureSolvers, MirroredGasGivesTheMirroredResult) {
  const std::vector<MovingSolid> solids = threeSolids();
  for (const PressureSolver& solver : fastSolvers)
    for (int axis = 0; axis < 3; ++axis) {
      FluidSettings s = box({16, 16, 16});
      s.faces[lowerFaceOf(axis)] = FaceKind::noSlip;
      s.pressure = solver;
      FluidState gas = stirredGas(s, solids), mirror = gas;
      mirror.velocity = mirrored(gas.velocity, axis);
      mirror.divergence = mirrored(gas.divergence, axis);
      mirror.solid.inside = mirrored(gas.solid.inside, axis);
      mirror.solid.region = mirrored(gas.solid.region, axis);
      for (int a = 0; a < 3; ++a)
        mirror.solid.openShare.component(a) = mirrored(gas.solid.openShare.component(a), axis);
      FluidSettings other = s;
      std::swap(other.faces[lowerFaceOf(axis)], other.faces[upperFaceOf(axis)]);
      PressureScratch scratch;
      project(gas, s, 0.1, scratch);
      project(mirror, other, 0.1, scratch);
      const MacVelocity back = mirrored(mirror.velocity, axis);
      for (int a = 0; a < 3; ++a)  // both are within 1e-5 of the source; speeds are about 1
        EXPECT_LT(largestDifference(back.component(a).values, gas.velocity.component(a).values), 2e-4);
    }
}

TEST(PressureSolvers, AnyThreadsAndVectorWidthGiveTheSameBits) {
  const std::vector<MovingSolid> solids = threeSolids();
  for (const PressureSolver& solver : fastSolvers)
    for (const bool withSolids : {false, true}) {
      FluidSettings s = box({20, 18, 21});
      s.pressure = solver;
      std::vector<FluidState> results;
      for (const int threads : {1, 2})
        for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
          const ThreadLimit limit(threads);
          forceVectorPath(path);
          results.push_back(stirredGas(s, withSolids ? std::span(solids) : std::span<MovingSolid>()));
          PressureScratch scratch;
          project(results.back(), s, 0.1, scratch);
        }
      for (const FluidState& result : results) {
        EXPECT_EQ(result.velocity, results[0].velocity);
        EXPECT_EQ(result.pressure, results[0].pressure);
      }
    }
}

/// A hollow box: gas inside it has no way out.
MovingSolid hollowBox() {
  TriangleMesh hollow = boxMesh({.6, .6, .6}, false);
  const TriangleMesh inner = boxMesh({.4, .4, .4}, false);
  const auto base = static_cast<std::uint32_t>(hollow.vertices.size());
  hollow.vertices.insert(hollow.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  for (const Triangle& t : inner.triangles) hollow.triangles.push_back({t[0] + base, t[2] + base, t[1] + base});
  return solidAt({.5, .5, .5}, hollow);
}

TEST(PressureSolvers, ASealedPocketKeepsItsSourceToItselfAndIsReported) {
  const MovingSolid head[] = {hollowBox()};
  for (const PressureSolver& solver : fastSolvers) {
    FluidSettings s = box({20, 20, 20});
    s.pressure = solver;
    FluidState gas = gasIn(s, head);
    ASSERT_EQ(gas.solid.pocketCount(), 1);
    gas.divergence(10, 10, 10) = 40;
    PressureScratch scratch;
    EXPECT_THROW(project(gas, s, 0.1, scratch), InputError);
    s.removeMeanSource = true;
    const PressureReport report = project(gas, s, 0.1, scratch);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.sealedPockets, 1);
    const double volume = 40 * s.cellSize * s.cellSize * s.cellSize;
    EXPECT_NEAR(report.removedSource / volume, 1, 1e-5);
    EXPECT_LT(std::abs(outwardVolume(gas, s)), 1e-5 * volume);
  }
}

TEST(PressureSolvers, APeriodicBoxIsMadeFreeOfDivergenceAndItsSeamIsNoPlaceApart) {
  const std::vector<MovingSolid> solids = threeSolids();
  for (const bool withSolids : {false, true}) {
    FluidSettings s = box({20, 16, 18});
    s.faces = {FaceKind::periodic, FaceKind::periodic, FaceKind::noSlip,
               FaceKind::open,     FaceKind::periodic, FaceKind::periodic};
    FluidState gas = stirredGas(s, withSolids ? std::span(solids) : std::span<MovingSolid>());
    CellField b{CellLayout(s.cells)};
    const double before = computeSource(gas, b).source;
    PressureScratch scratch;
    EXPECT_TRUE(project(gas, s, 0.05, scratch).converged);
    EXPECT_LE(computeSource(gas, b).source / before, 1e-4);
    for (int k = 0; k < 18; ++k)
      for (int j = 0; j < 16; ++j) EXPECT_EQ(gas.velocity.u(0, j, k), gas.velocity.u(20, j, k));
    s.pressure = MultigridSolver{};
    EXPECT_THROW(project(gas, s, 0.05, scratch), InputError);
  }
}

}  // namespace
}  // namespace brisance
