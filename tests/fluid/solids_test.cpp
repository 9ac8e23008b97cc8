// Solids in the gas: what faces let through, and what gas does about it.
#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/projection.h"
#include "fluid/solid_samples.h"
#include "mesh/mass_properties.h"

namespace brisance {
namespace {
using namespace test;

TEST(SolidFractions, TheClosedSharesOfAPlaneAddUpToTheBodysCrossSection) {
  constexpr double side = .31;  // [m] of a square rod through the box
  for (std::uint64_t n = 0; n < 10; ++n) {
    const FluidSettings s = box({14, 16, 18});
    const Random random(5, Stream::test);
    const double turn = 6.3 * random.uniform(n);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3d size{side, side, side}, along, centre{.52, .55, .61};
      size[axis] = 9;
      along[axis] = 1;
      const MovingSolid rod[] = {boxAt(centre, size, axisAngle(along, turn))};
      const SolidStamp solid = stampSolids(s, rod);
      double closed = 0;
      forFaces(solid.openShare, [&](int a, const Vec3i& face, std::int64_t, float share) {
        if (a == axis && face[axis] == 7) closed += 1 - share;
      });
      // Faces of less than 1/1000 open, and cells of a few hundredths, are closed: some thousandths of the rod's area.
      EXPECT_NEAR(closed * s.cellSize * s.cellSize / (side * side), 1, .012) << axis << " " << n;
    }
  }
}

TEST(SolidFractions, WhatGasMayFillOfTheCellsAroundABallIsAllButTheBall) {
  const FluidSettings s = box({20, 20, 20});
  const MovingSolid ball[] = {solidAt({.47, .52, .5}, sphereMesh(.23, 24))};
  const SolidStamp solid = stampSolids(s, ball);
  double closed = 0;  // each plane of faces stands for a slice as thick as a cell
  forFaces(solid.openShare, [&](int axis, const Vec3i&, std::int64_t, float share) {
    if (axis == 0) closed += 1 - share;
  });
  const double volume = solidProperties(*ball[0].mesh).volume;
  EXPECT_NEAR(closed * std::pow(s.cellSize, 3) / volume, 1, .01);
}

/// What a stream along a wall at some slope, and past both ends of the box, would pile up: |div u| over |u| / h, L2
/// over the cells of gas, against what it would if faces were open or closed.
TEST(SolidFractions, AStreamAlongATiltedWallMeetsNoSteps) {
  const FluidSettings s = box({20, 20, 20});
  double cut = 0, steps = 0;
  for (std::uint64_t n = 0; n < 12; ++n) {
    const Quaternion turned = anyOrientation(n);
    const MovingSolid wall[] = {boxAt(Vec3d(.5, .5, .5) + rotate(turned, Vec3d(0, 0, 2.02)), {8, 8, 4}, turned)};
    FluidState gas = gasIn(s, wall);
    stream(gas, rotate(turned, Vec3d(.8, .6, 0)));
    CellField b{CellLayout(s.cells)};
    cut += std::pow(computeSource(gas, b).source, 2);
    forFaces(gas.solid.openShare, [&](int axis, const Vec3i&, std::int64_t index, float share) {
      float& open = gas.solid.openShare.component(axis).values[index];
      open = share < .5f ? 0 : 1;
    });
    stream(gas, rotate(turned, Vec3d(.8, .6, 0)));
    steps += std::pow(computeSource(gas, b).source, 2);
  }
  EXPECT_LT(std::sqrt(cut / steps), .15);
}

TEST(SolidFractions, GasAtRestUnderItsWeightStaysAtRestBetweenSlantedWalls) {
  for (std::uint64_t n = 0; n < 6; ++n) {
    FluidSettings s = box({16, 16, 16});
    s.faces[2] = FaceKind::freeSlip;
    s.force = {0, -9.81, 0};
    s.pressure = AutomaticSolver{1e-6};
    const Quaternion turned = anyOrientation(n);
    const MovingSolid solids[] = {boxAt({.5, .1, .5}, {.9, .35, .6}, turned),
                                  solidAt({.6, .7, .4}, sphereMesh(.16, 12)),
                                  boxAt({.3, .6, .6}, {.6, .006, .5}, turned)};
    s.faces = allFaces(FaceKind::freeSlip);
    FluidState gas = gasIn(s, solids);
    FluidScratch scratch;
    for (int step = 0; step < 4; ++step) stepFluid(gas, s, 1, 0.01, scratch);
    double largest = 0;
    forFaces(gas.velocity, [&](int, const Vec3i&, std::int64_t, float speed) {
      largest = std::max(largest, std::abs(double(speed)));
    });
    EXPECT_LT(largest, 2e-5) << n;  // of the 0.4 m/s that falling freely would have given
  }
}

TEST(SolidFractions, FlowPastABallKeepsItsSymmetry) {
  for (int axis = 0; axis < 3; ++axis) {
    FluidSettings s = box({24, 24, 24});
    s.wind[axis] = 1;
    s.pressure = AutomaticSolver{1e-6};
    const MovingSolid ball[] = {solidAt({.5, .5, .5}, sphereMesh(.2, 24))};
    FluidState gas = gasIn(s, ball);
    FluidScratch scratch;
    for (int step = 0; step < 6; ++step) stepFluid(gas, s, 1, 0.02, scratch);
    double turned = 0, fastest = 0;
    forFaces(gas.velocity, [&](int, const Vec3i&, std::int64_t, float speed) {
      fastest = std::max(fastest, std::abs(double(speed)));
    });
    for (int across = 0; across < 3; ++across) {
      if (across == axis) continue;
      const MacVelocity mirror = mirrored(gas.velocity, across);
      for (int a = 0; a < 3; ++a)
        turned = std::max(turned, largestDifference(mirror.component(a).values, gas.velocity.component(a).values));
    }
    EXPECT_GT(fastest, 1.05);
    EXPECT_LT(turned, 2e-4) << axis;
  }
}

/// A pane a tenth of a cell thick through the whole box, and a source that only one side of it knows.
struct Partition {
  Vec3d normal, through;
  double height(const Vec3d& place) const { return dot(place - through, normal); }
};

Partition partition(std::uint64_t n) {
  const Random random(9, Stream::test);
  const Vec3d place{.35 + .3 * random.uniform(3 * n), .35 + .3 * random.uniform(3 * n + 1),
                    .35 + .3 * random.uniform(3 * n + 2)};
  return {rotate(anyOrientation(n), Vec3d(0, 0, 1)), place};
}

void addSourceBelow(const Partition& pane, FluidState& gas) {
  for (int k = 0; k < gas.divergence.size.z; ++k)
    for (int j = 0; j < gas.divergence.size.y; ++j)
      for (int i = 0; i < gas.divergence.size.x; ++i) {
        const double height = pane.height(gas.divergence.position(i, j, k)) / gas.divergence.cellSize;
        if (height < -1.5 && height > -4) gas.divergence(i, j, k) = 20;
      }
}

/// Gas with a source and heat below the partition, stepped three times: nothing of either may be above it.
void expectNothingPasses(const FluidSettings& s, const Partition& pane, std::span<const MovingSolid> solids,
                         double clear, std::uint64_t n) {
  FluidState gas = gasIn(s, solids);
  addSourceBelow(pane, gas);
  FluidScratch scratch;
  for (float& t : gas.temperature.values) t = 300;
  for (std::size_t c = 0; c < gas.divergence.values.size(); ++c)
    if (gas.divergence.values[c] > 0) gas.heatRate.values[c] = 1e4;
  for (int step = 0; step < 3; ++step) stepFluid(gas, s, 1, 0.01, scratch);
  double passed = 0, hottest = 0;
  forFaces(gas.velocity, [&](int axis, const Vec3i& face, std::int64_t, float speed) {
    const Vec3d place = gas.velocity.component(axis).position(face.x, face.y, face.z);
    if (pane.height(place) > clear) passed += std::abs(double(speed)) * s.cellSize * s.cellSize;
  });
  for (int k = 0; k < s.cells.z; ++k)
    for (int j = 0; j < s.cells.y; ++j)
      for (int i = 0; i < s.cells.x; ++i)
        if (pane.height(gas.temperature.position(i, j, k)) > clear)
          hottest = std::max(hottest, gas.temperature(i, j, k) - 300.0);
  EXPECT_GT(createdVolume(gas), 0);
  EXPECT_EQ(passed, 0) << n;
  EXPECT_EQ(hottest, 0) << n;
}

TEST(ThinSolids, APaneATenthOfACellThickLetsNothingPassAtAnyOrientationAndPlace) {
  for (std::uint64_t n = 0; n < 60; ++n) {
    const FluidSettings s = box({16, 16, 16});
    const Partition pane = partition(n);
    const MovingSolid solid[] = {boxAt(pane.through, {8, 8, .1 * s.cellSize}, anyOrientation(n))};
    expectNothingPasses(s, pane, solid, s.cellSize, n);
  }
}

/// A thick wall through the whole box with a square opening, and a pane in it that just reaches the opening's edges.
std::vector<MovingSolid> glazedWall(const Partition& at, const Quaternion& turned, double opening, double thickness) {
  constexpr double far = 8;
  std::vector<MovingSolid> solids;
  for (int axis = 0; axis < 2; ++axis)
    for (const int side : {-1, 1}) {
      Vec3d offset, size{far, far, thickness};
      offset[axis] = side * (far + opening) / 2;
      if (axis == 1) size.x = opening;
      solids.push_back(boxAt(at.through + rotate(turned, offset), size, turned));
    }
  const double overlap = 1e-6;  // [m], so that rounding opens no gap
  solids.push_back(boxAt(at.through, {opening + overlap, opening + overlap, .1 / 16}, turned));
  return solids;
}

TEST(ThinSolids, APaneClosesAnOpeningOfAnySizeAtAnyOrientationAndPlace) {
  for (std::uint64_t n = 0; n < 60; ++n) {
    const FluidSettings s = box({16, 16, 16});
    const double opening = (.4 + 5 * Random(13, Stream::test).uniform(n)) * s.cellSize;
    const double thickness = n % 2 == 0 ? 2.2 * s.cellSize : .3 * s.cellSize;
    const Partition wall = partition(n);
    expectNothingPasses(s, wall, glazedWall(wall, anyOrientation(n), opening, thickness), 2.2 * s.cellSize, n);
  }
}

/// The mesh seen in a mirror across x, y or z, its triangles still facing outwards.
TriangleMesh mirroredMesh(TriangleMesh mesh, int axis) {
  for (Vec3d& vertex : mesh.vertices) vertex[axis] = -vertex[axis];
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

/// A slanted pane, a ball and a block with a slant, or what a mirror across the middle of the box shows of them.
std::vector<MovingSolid> roomOfSolids(int mirrorAxis) {
  struct Part {
    TriangleMesh mesh;
    Vec3d place;
  };
  const auto turnedBox = [](const Vec3d& size, std::uint64_t n) {
    TriangleMesh mesh = boxMesh(size, false);
    for (Vec3d& vertex : mesh.vertices) vertex = rotate(anyOrientation(n), vertex);
    return mesh;
  };
  const Part parts[] = {{turnedBox({.5, .4, .005}, 1), {.62, .55, .48}},
                        {sphereMesh(.13, 12), {.31, .6, .57}},
                        {turnedBox({.3, .25, .35}, 2), {.45, .1, .3}}};
  std::vector<MovingSolid> solids;
  for (const Part& part : parts) {
    Vec3d place = part.place;
    if (mirrorAxis >= 0) place[mirrorAxis] = 1 - place[mirrorAxis];
    solids.push_back(solidAt(place, mirrorAxis >= 0 ? mirroredMesh(part.mesh, mirrorAxis) : part.mesh));
  }
  return solids;
}

/// A hot source beside the middle of a box with wind, after some steps among solids.
FluidState burstAmongSolids(int mirrorAxis, const AdvectionScheme& scheme) {
  FluidSettings s = box({18, 18, 18});
  s.pressure = AutomaticSolver{1e-6};
  s.advection = scheme;
  s.vorticityConfinement = .3;
  s.wind = {.4, .2, -.3};
  Vec3d middle{.43, .38, .61};
  if (mirrorAxis >= 0) {
    s.wind[mirrorAxis] = -s.wind[mirrorAxis];
    middle[mirrorAxis] = 1 - middle[mirrorAxis];
  }
  FluidState gas = gasIn(s, roomOfSolids(mirrorAxis));
  FluidScratch scratch;
  for (int step = 0; step < 6; ++step) {
    const auto source = [&](const Vec3d& p) { return std::max(0.0, 1 - length(p - middle) / .2); };
    setComponent(gas.divergence, [&](const Vec3d& p) { return 12 * source(p); });
    setComponent(gas.heatRate, [&](const Vec3d& p) { return 2e5 * source(p); });
    for (std::size_t c = 0; c < gas.divergence.values.size(); ++c)
      if (gas.solid.inside.values[c]) gas.divergence.values[c] = gas.heatRate.values[c] = 0;
    stepFluid(gas, s, 1, 0.01, scratch);
  }
  return gas;
}

TEST(SolidFractions, ABurstAmongSolidsSeenInAMirrorIsTheBurstAmongMirroredSolids) {
  const AdvectionScheme schemes[] = {DonorCell{}, MacCormack{}, SemiLagrangian{}};
  for (const AdvectionScheme& scheme : schemes) {
    const FluidState gas = burstAmongSolids(-1, scheme);
    double fastest = 0, hottest = 0;
    forFaces(gas.velocity, [&](int, const Vec3i&, std::int64_t, float speed) {
      fastest = std::max(fastest, std::abs(double(speed)));
    });
    for (const float t : gas.temperature.values) hottest = std::max(hottest, double(t));
    for (int axis = 0; axis < 3; ++axis) {
      const FluidState other = burstAmongSolids(axis, scheme);
      const MacVelocity back = mirrored(other.velocity, axis);
      for (int a = 0; a < 3; ++a)
        EXPECT_LT(largestDifference(back.component(a).values, gas.velocity.component(a).values), 2e-4 * fastest)
            << scheme.index() << " " << axis;
      EXPECT_LT(largestDifference(mirrored(other.temperature, axis).values, gas.temperature.values),
                2e-4 * (hottest - 300))
          << scheme.index() << " " << axis;
    }
  }
}

}  // namespace
}  // namespace brisance
