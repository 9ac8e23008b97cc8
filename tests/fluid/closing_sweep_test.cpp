#include "fluid/closing_sweep.h"

#include "base/parallel.h"
#include "base/random.h"
#include "base/vector_path.h"
#include "fluid/fluid_fixture.h"
#include "fluid/pressure.h"
#include "fluid/projection.h"
#include "mesh/shapes.h"

namespace brisance {
namespace {
using namespace test;

constexpr double dt = 0.01;

/// More planes than one task closes.
FluidSettings boxWith(const Faces& faces) {
  FluidSettings s = box({19, 14, 37});
  s.faces = faces;
  return s;
}

FluidState gasAtRandom(const FluidSettings& s, bool solids) {
  const MovingSolid block{
      std::make_shared<const TriangleMesh>(boxMesh({.3, .25, .4}, false)), {{.5, .4, .9}, {}}, {}, {}};
  FluidState gas = solids ? gasIn(s, std::array{block}) : gasIn(s);
  const Random random(2, Stream::test);
  std::uint64_t n = 0;
  const auto fill = [&](Grid3<float>& grid) {
    for (float& value : grid.values) value = static_cast<float>(random.uniform(n++) - .5);
  };
  for (int axis = 0; axis < 3; ++axis) fill(gas.velocity.component(axis));
  fill(gas.divergence);
  fill(gas.pressure);
  return gas;
}

CellField fieldAtRandom(const Vec3i& cells) {
  CellField x{CellLayout(cells)};
  const Random random(3, Stream::test);
  for (int k = 0; k < cells.z; ++k)
    for (int j = 0; j < cells.y; ++j)
      for (int i = 0; i < cells.x; ++i)
        x(i, j, k) = static_cast<float>(random.uniform(static_cast<std::uint64_t>(x.layout.index(i, j, k))) - .5);
  return x;
}

/// x of a cell, or of the ghost beyond a face.
double valueAt(const CellField& x, const Faces& faces, Vec3i cell) {
  for (int axis = 0; axis < 3; ++axis) {
    const int n = x.layout.cells[axis];
    if (cell[axis] >= 0 && cell[axis] < n) continue;
    if (!isPeriodic(faces, axis)) return 0;
    cell[axis] = (cell[axis] + n) % n;
  }
  return x(cell.x, cell.y, cell.z);
}

/// What the gradient of x takes from a face.
double taken(const FluidState& gas, const Faces& faces, const CellField& x, int axis, const Vec3i& face) {
  Vec3i below = face;
  --below[axis];
  const int last = gas.pressure.size[axis];
  const bool border = face[axis] == 0 || face[axis] == last;
  const FaceKind kind = faces[2 * axis + (face[axis] == last)];
  const double coupling = !border || kind == FaceKind::periodic ? 1 : kind == FaceKind::open ? 2 : 0;
  const double share = gas.solid.openShare.component(axis)(face.x, face.y, face.z);
  return coupling * share * (valueAt(x, faces, face) - valueAt(x, faces, below)) / gas.pressure.cellSize;
}

/// The findings, from their definitions.
FlowFindings foundIn(const FluidState& gas, double h) {
  FlowFindings found;
  const MacVelocity& m = gas.velocity;
  const Vec3i n = gas.pressure.size;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        const auto faster = [](float a, float b) { return std::max(std::abs(a), std::abs(b)); };
        found.fastest = std::max<double>(found.fastest, faster(m.u(i, j, k), m.u(i + 1, j, k)) +
                                                            faster(m.v(i, j, k), m.v(i, j + 1, k)) +
                                                            faster(m.w(i, j, k), m.w(i, j, k + 1)));
        const double phi = gas.divergence(i, j, k);
        found.outward += velocityDivergence(m, i, j, k);  // what is inside cancels out
        if (gas.solid.inside(i, j, k)) continue;
        found.wrong += std::pow(velocityDivergence(m, i, j, k) / h - phi, 2);
        found.source += phi * phi;
        found.created += phi;
      }
  return found;
}

std::vector<FluidSettings> allKindsOfBoxes() {
  using enum FaceKind;
  return {boxWith(allFaces(open)), boxWith(allFaces(periodic)), boxWith({open, noSlip, freeSlip, open, noSlip, open}),
          boxWith({periodic, periodic, open, freeSlip, open, noSlip})};
}

TEST(ClosingSweep, TakesTheGradientAndFindsWhatIsThere) {
  for (const FluidSettings& s : allKindsOfBoxes())
    for (const bool solids : {false, true}) {
      const FluidState before = gasAtRandom(s, solids);
      const CellField x = fieldAtRandom(s.cells);
      FluidState gas = before;
      const FlowFindings found = closeStep(gas, s.faces, dt, x, false);
      for (int axis = 0; axis < 3; ++axis) {
        const Grid3<float>& speed = gas.velocity.component(axis);
        for (int k = 0; k < speed.size.z; ++k)
          for (int j = 0; j < speed.size.y; ++j)
            for (int i = 0; i < speed.size.x; ++i)
              ASSERT_NEAR(speed(i, j, k),
                          before.velocity.component(axis)(i, j, k) - taken(before, s.faces, x, axis, {i, j, k}), 1e-5);
      }
      for (int k = 0; k < s.cells.z; ++k)
        for (int j = 0; j < s.cells.y; ++j)
          for (int i = 0; i < s.cells.x; ++i)
            ASSERT_NEAR(gas.pressure(i, j, k),
                        gas.solid.inside(i, j, k) ? 0 : before.pressure(i, j, k) + x(i, j, k) / dt, 1e-4);
      const FlowFindings expected = foundIn(gas, s.cellSize);
      EXPECT_NEAR(found.wrong / expected.wrong, 1, 1e-8);  // single precision, added up
      EXPECT_NEAR(found.source / expected.source, 1, 1e-8);
      EXPECT_NEAR(found.created, expected.created, 1e-5);
      EXPECT_NEAR(found.outward, expected.outward, 1e-9);
      EXPECT_EQ(found.fastest, expected.fastest);
      EXPECT_NEAR(found.outward * s.cellSize * s.cellSize, outwardVolume(gas, s), 1e-12);
      const FlowFindings looked = lookAtFlow(gas);
      EXPECT_EQ(found.wrong, looked.wrong);
      EXPECT_EQ(found.fastest, looked.fastest);
    }
}

TEST(ClosingSweep, HasTheSameBitsWithAnyVectorsAndThreads) {
  for (const FluidSettings& s : allKindsOfBoxes()) {
    const CellField x = fieldAtRandom(s.cells);
    const auto closed = [&](VectorPath path, int threads) {
      const ThreadLimit limit(threads);
      forceVectorPath(path);
      FluidState gas = gasAtRandom(s, true);
      const FlowFindings found = closeStep(gas, s.faces, dt, x, true);
      forceVectorPath(VectorPath::avx512);
      return std::pair(gas, found);
    };
    const auto [plain, first] = closed(VectorPath::plain, 1);
    for (const auto& [gas, found] : {closed(VectorPath::avx2, 2), closed(VectorPath::avx512, 3)}) {
      EXPECT_EQ(gas.velocity, plain.velocity);
      EXPECT_EQ(gas.pressure, plain.pressure);
      EXPECT_EQ(found.wrong, first.wrong);
      EXPECT_EQ(found.created, first.created);
      EXPECT_EQ(found.outward, first.outward);
      EXPECT_EQ(found.fastest, first.fastest);
    }
  }
}

/// What a step hands to the next is what a fresh look would find.
TEST(ClosingSweep, AStepKnowsTheLimitsOfTheNext) {
  FluidSettings s = boxWith(allFaces(FaceKind::open));
  s.buoyancy = 0.02;
  FluidState gas = gasIn(s);
  gas.divergence(9, 7, 18) = 20;
  gas.heatRate(9, 7, 18) = 4000;
  FluidScratch scratch;
  StepLimits limits = limitsOf(gas);
  for (int n = 0; n < 3; ++n) {
    const double length = std::min(dt, longestStep(gas, s, 20, limits));
    EXPECT_EQ(length, std::min(dt, longestStep(gas, s, 20)));
    limits = stepFluid(gas, s, 1, length, scratch, limits).next;
    EXPECT_GT(limits.hottest, 300);
    EXPECT_EQ(limits.fastest, limitsOf(gas).fastest);
    EXPECT_EQ(limits.hottest, limitsOf(gas).hottest);
  }
}

}  // namespace
}  // namespace brisance
