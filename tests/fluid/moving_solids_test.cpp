// Bodies that move in the gas, and gas that moves bodies.
#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/projection.h"
#include "fluid/solid_samples.h"

namespace brisance {
namespace {
using namespace test;

/// Gas with moving bodies in it.
struct MovingScene {
  FluidSettings settings;
  SolidStamper stamper;
  FluidState gas;
  FluidScratch scratch;

  explicit MovingScene(const FluidSettings& s, std::span<const MovingSolid> fixed = {})
      : settings(s), stamper(s, fixed), gas(makeFluid(s, stamper.fixed(), 1)) {}
  void put(std::span<const MovingSolid> bodies) { moveSolids(gas, bodies, settings, stamper); }
  void step(double dt) { stepFluid(gas, settings, 1, dt, scratch); }
};

/// A tube of free-slip walls, open at its upper end along an axis.
FluidSettings tube(int axis) {
  FluidSettings s = box({16, 16, 16}, FaceKind::freeSlip);
  s.faces[upperFaceOf(axis)] = FaceKind::open;
  return s;
}

TEST(MovingSolids, APistonDrivesOutExactlyTheVolumeThatItTakes) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double speed : {2.0, -1.5}) {
      MovingScene scene(tube(axis));
      Vec3d place{.5, .5, .5}, velocity;
      place[axis] = -1.37;
      velocity[axis] = speed;
      MovingSolid piston = boxAt(place, {4, 4, 4});
      piston.velocity = velocity;
      const double dt = 0.01;
      for (int n = 0; n < 6; ++n) {
        scene.put({&piston, 1});
        scene.step(dt);
        EXPECT_NEAR(outwardVolume(scene.gas, scene.settings) / speed, 1, 1e-5) << axis << " " << n;  // of a 1 m2 tube
        piston.pose.position += velocity * dt;
      }
    }
}

TEST(MovingSolids, ABodyWhollyInTheGasTakesNoVolumeHoweverItMoves) {
  for (std::uint64_t n = 0; n < 6; ++n) {
    MovingScene scene(box({18, 18, 18}));
    MovingSolid body = boxAt({.5, .48, .53}, {.4, .23, .02}, anyOrientation(n));
    body.velocity = {1, -2, .5};
    body.angularVelocity = {3, 1, -2};
    scene.put({&body, 1});
    scene.step(0.005);
    EXPECT_LT(std::abs(outwardVolume(scene.gas, scene.settings)), 1e-4) << n;  // it sweeps .09 m2 at 2.3 m/s: 0.2 m3/s
  }
}

TEST(MovingSolids, WhereTheyAreDecidesAndNotWhereTheyWere) {
  const FluidSettings s = box({20, 18, 16});
  const MovingSolid wall[] = {boxAt({.5, .2, .5}, {1.4, .1, .3}, anyOrientation(3))};
  SolidStamper travelled(s, wall), fresh(s, wall);
  SolidStamp there = travelled.fixed(), straight = fresh.fixed();
  MovingSolid bodies[] = {boxAt({.4, .3, .4}, {.3, .01, .2}), solidAt({.6, .6, .4}, sphereMesh(.12, 12))};
  const Random random(4, Stream::test);
  for (std::uint64_t n = 0; n < 8; ++n) {
    for (std::uint64_t b = 0; b < 2; ++b)
      bodies[b].pose = {Vec3d(.5, .4, .4) + random.normal3(2 * n + b) * .15, anyOrientation(2 * n + b)};
    travelled.stampMoving(bodies, there);
  }
  fresh.stampMoving(bodies, straight);
  EXPECT_EQ(there.openShare, straight.openShare);
  EXPECT_EQ(there.inside, straight.inside);
  EXPECT_EQ(there.region, straight.region);
  EXPECT_EQ(there.cutRows, straight.cutRows);
  ASSERT_EQ(there.bodyFaces.size(), straight.bodyFaces.size());
  for (std::size_t n = 0; n < there.bodyFaces.size(); ++n) {
    EXPECT_EQ(there.bodyFaces[n].index, straight.bodyFaces[n].index);
    EXPECT_EQ(there.bodyFaces[n].share, straight.bodyFaces[n].share);
  }
  MovingSolid all[] = {wall[0], bodies[0], bodies[1]};
  const SolidStamp still = stampSolids(s, all);
  EXPECT_EQ(there.openShare, still.openShare);
  EXPECT_EQ(there.inside, still.inside);
}

TEST(MovingSolids, CellsThatABodyUncoversHaveWhatTheGasAroundThemHas) {
  MovingScene scene(box({16, 16, 16}));
  MovingSolid body = boxAt({.4, .5, .5}, {.3, .3, .3});
  scene.put({&body, 1});
  for (std::size_t n = 0; n < scene.gas.temperature.values.size(); ++n)
    scene.gas.temperature.values[n] = scene.gas.solid.inside.values[n] ? 9999.f : 400.f;
  body.pose.position.x = .75;
  scene.put({&body, 1});
  for (std::size_t n = 0; n < scene.gas.temperature.values.size(); ++n)
    if (!scene.gas.solid.inside.values[n]) {
      EXPECT_EQ(scene.gas.temperature.values[n], 400);
    }
}

/// Momentum of the gas along an axis over its density, each sample standing for the gas between two cell centres.
double momentum(const FluidState& gas, int axis) {
  double sum = 0;
  const Grid3<float>& speed = gas.velocity.component(axis);
  forFaces(gas.velocity, [&](int a, const Vec3i& face, std::int64_t, float u) {
    const bool end = face[a] == 0 || face[a] + 1 == speed.size[a];
    if (a == axis) sum += (end ? 0.5 : 1.0) * u;
  });
  return sum * std::pow(speed.cellSize, 3);
}

/// Impulse of pressure on everything that closes faces along an axis, walls of the box included, over the density.
double impulseOnSolids(const FluidState& gas, const FluidSettings& s, int axis, double dt) {
  double sum = 0;
  const Grid3<float>& p = gas.pressure;
  forFaces(gas.solid.openShare, [&](int a, const Vec3i& face, std::int64_t, float share) {
    if (a != axis) return;
    Vec3i lower = face;
    --lower[axis];
    const bool atLower = face[axis] == 0, atUpper = face[axis] == s.cells[axis];
    const double below = atLower ? 0.0 : p(lower.x, lower.y, lower.z);
    const double above = atUpper ? 0.0 : p(face.x, face.y, face.z);
    sum += (1 - share) * (below - above);
  });
  return dt * sum * s.cellSize * s.cellSize;
}

TEST(PressurePush, TheImpulseOnBodiesAndWallsIsWhatTheGasLoses) {
  for (const bool moving : {false, true})
    for (std::uint64_t n = 0; n < 4; ++n) {
      FluidSettings s = box({18, 16, 20});
      s.faces[2] = s.faces[4] = FaceKind::noSlip;
      MovingSolid solids[] = {boxAt({.4, .3, .5}, {.3, .02, .4}, anyOrientation(n)),
                              solidAt({.7, .5, .6}, sphereMesh(.15, 16)),
                              boxAt({.3, .7, .5}, {.3, .004, .3}, anyOrientation(n + 9))};
      if (moving)
        for (MovingSolid& solid : solids) {
          solid.velocity = {.3, -1, .5};
          solid.inverseMass = 1 / .02;
          solid.inverseInertia = Mat3{} * 900.0;
        }
      MovingScene scene(s, moving ? std::span<const MovingSolid>() : std::span<const MovingSolid>(solids));
      if (moving) scene.put(solids);
      FluidState& gas = scene.gas;
      const Random random(n, Stream::test);
      forFaces(gas.solid.openShare, [&](int axis, const Vec3i&, std::int64_t index, float share) {
        gas.velocity.component(axis).values[index] += share * static_cast<float>(random.normal(index + 7 * axis));
      });
      setComponent(gas.divergence, [](const Vec3d& p) { return length(p - Vec3d(.5, .4, .3)) < .2 ? 25. : 0.; });
      FluidState before = gas;
      PressureScratch scratch;
      constexpr double dt = 0.02;
      project(gas, s, dt, scratch);
      for (int axis = 0; axis < 3; ++axis) {
        // What bodies carry is not the gas' momentum: its change on their faces is taken out.
        double carried = 0, bodies = 0;
        for (const BodyFace& f : gas.solid.bodyFaces) {
          const Vec3d place = gas.velocity.component(f.axis).position(f.face.x, f.face.y, f.face.z);
          const Vec3d change =
              gas.solid.bodies[f.body].velocityAt(place) - before.solid.bodies[f.body].velocityAt(place);
          if (f.axis == axis) carried += f.share * change[axis] * std::pow(s.cellSize, 3);
        }
        for (std::size_t b = 0; b < gas.solid.bodies.size(); ++b)
          bodies += (gas.solid.bodies[b].velocity - before.solid.bodies[b].velocity)[axis] /
                    gas.solid.bodies[b].inverseMass / s.density;
        const double lost = momentum(before, axis) - momentum(gas, axis) + carried;
        const double impulse = impulseOnSolids(gas, s, axis, dt);
        const double scale = std::abs(lost) + std::abs(impulse) + 0.01;
        EXPECT_NEAR(lost / scale, impulse / scale, 1e-4) << moving << n << axis;
        if (moving && axis == 0) {  // no wall of the box stands across x: all of it went to bodies
          EXPECT_NEAR(bodies / scale, impulse / scale, 1e-4) << n;
        }
      }
    }
}

TEST(PressurePush, AFreePaneInATubeIsDrivenByAllTheGasBehindIt) {
  // Source Q behind a pane that fills a tube: at any weight the gas before it and it move at Q / area, all at once.
  for (int axis = 0; axis < 3; ++axis)
    for (const double mass : {1e-4, 1.0, 100.0}) {  // [kg]; the gas in the tube weighs about 1
      FluidSettings s = tube(axis);
      s.pressure = AutomaticSolver{1e-6};
      MovingScene scene(s);
      Vec3d place{.5, .5, .5}, size{4, 4, 4};
      place[axis] = .41;
      size[axis] = .1 * s.cellSize;
      MovingSolid pane = boxAt(place, size);
      pane.inverseMass = 1 / mass;
      for (int n = 0; n < 5; ++n) {
        scene.put({&pane, 1});
        ASSERT_EQ(scene.gas.solid.pocketCount(), 1);
        for (float& phi : scene.gas.divergence.values) phi = 0;
        int cell[3] = {8, 8, 8};
        cell[axis] = 2;
        scene.gas.divergence(cell[0], cell[1], cell[2]) = static_cast<float>(3 / std::pow(s.cellSize, 3));
        scene.step(0.005);
        pane.velocity = scene.gas.solid.bodies[0].velocity;
        pane.pose.position += pane.velocity * 0.005;
        EXPECT_NEAR(pane.velocity[axis], 3, 3e-3) << mass << " " << n;
        EXPECT_NEAR(outwardVolume(scene.gas, s), 3, 3e-3) << mass << " " << n;
      }
    }
}

TEST(PressurePush, ALightPaneInAStreamComesToItsSpeedAndNeverBeyond) {
  for (const double massPerArea : {1e-4, .01, 1.0}) {  // [kg/m2]; a cell of gas has 0.075
    FluidSettings s = box({16, 16, 16});
    s.wind = {0, 0, 4};
    MovingScene scene(s);
    MovingSolid pane = boxAt({.5, .5, .4}, {.4, .4, .1 * s.cellSize});
    const double mass = massPerArea * .16;
    pane.inverseMass = 1 / mass;
    pane.inverseInertia = inverse(Mat3{{{mass * .0133, 0, 0}, {0, mass * .0133, 0}, {0, 0, mass * .0267}}});
    double last = 0;
    for (int n = 0; n < 20; ++n) {
      scene.put({&pane, 1});
      scene.step(0.005);
      pane.velocity = scene.gas.solid.bodies[0].velocity;
      pane.pose.position += pane.velocity * 0.005;
      EXPECT_GE(pane.velocity.z, last - 0.05) << massPerArea;
      EXPECT_LE(pane.velocity.z, 4.05) << massPerArea;
      last = pane.velocity.z;
    }
    if (massPerArea < .1) {
      EXPECT_GT(last, 3.5) << massPerArea;
    }
    EXPECT_LT(std::abs(pane.velocity.x) + std::abs(pane.velocity.y), 1e-3);
  }
}

TEST(PressurePush, MirroredItIsTheMirroredPush) {
  for (int axis = 0; axis < 3; ++axis) {
    MacVelocity results[2];
    Vec3d speeds[2], spins[2];
    for (const int side : {0, 1}) {
      FluidSettings s = box({16, 16, 16});
      s.pressure = AutomaticSolver{1e-6};
      MovingScene scene(s);
      Vec3d place{.46, .55, .52}, burst{.3, .42, .37}, half{.5, .5, .5};
      // Only the axis-parallel pane and the source are mirrored: a box is its own mirror image.
      if (side == 1) place[axis] = 1 - place[axis];
      if (side == 1) burst[axis] = 1 - burst[axis];
      MovingSolid pane = boxAt(place, {.3, .02, .4});
      pane.inverseMass = 1 / .01;
      pane.inverseInertia = Mat3{} * 5000.0;
      scene.put({&pane, 1});
      setComponent(scene.gas.divergence, [&](const Vec3d& p) { return length(p - burst) < .12 ? 20. : 0.; });
      scene.step(0.01);
      results[side] = scene.gas.velocity;
      speeds[side] = scene.gas.solid.bodies[0].velocity;
      spins[side] = scene.gas.solid.bodies[0].angularVelocity;
    }
    EXPECT_GT(length(speeds[0]), 1e-3);
    speeds[1][axis] *= -1;
    EXPECT_LT(length(speeds[1] - speeds[0]), 1e-4 * length(speeds[0]));
    spins[1][axis] *= -1;  // an axial vector: the other two change sign
    EXPECT_LT(length(spins[1] + spins[0]), 1e-3 * length(spins[0]));
    const MacVelocity back = mirrored(results[1], axis);
    for (int a = 0; a < 3; ++a)
      EXPECT_LT(largestDifference(back.component(a).values, results[0].component(a).values), 2e-5);
  }
}

TEST(PressurePush, AnyThreadsAndVectorWidthGiveTheSameBits) {
  std::vector<FluidState> results;
  for (const int threads : {1, 2})
    for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
      const ThreadLimit limit(threads);
      forceVectorPath(path);
      MovingScene scene(box({20, 18, 16}));
      MovingSolid bodies[] = {boxAt({.4, .4, .4}, {.3, .01, .2}, anyOrientation(1)),
                              boxAt({.6, .5, .4}, {.2, .02, .3}, anyOrientation(2))};
      for (MovingSolid& body : bodies) {
        body.inverseMass = 1 / .01;
        body.inverseInertia = Mat3{} * 3000.0;
      }
      setComponent(scene.gas.divergence, [](const Vec3d& p) { return length(p - Vec3d(.5, .45, .3)) < .12 ? 9. : 0.; });
      for (int n = 0; n < 3; ++n) {
        scene.put(bodies);
        scene.step(0.005);
        for (int b = 0; b < 2; ++b) {
          bodies[b].velocity = scene.gas.solid.bodies[b].velocity;
          bodies[b].angularVelocity = scene.gas.solid.bodies[b].angularVelocity;
          bodies[b].pose.position += bodies[b].velocity * 0.005;
        }
      }
      results.push_back(scene.gas);
    }
  for (const FluidState& result : results) {
    EXPECT_EQ(result.velocity, results[0].velocity);
    EXPECT_EQ(result.pressure, results[0].pressure);
    EXPECT_EQ(result.solid.bodies[1].velocity, results[0].solid.bodies[1].velocity);
  }
}

}  // namespace
}  // namespace brisance
