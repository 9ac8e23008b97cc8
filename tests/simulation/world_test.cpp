#include "simulation/world.h"

#include <gtest/gtest.h>

#include <sstream>

#include "base/check.h"
#include "base/parallel.h"
#include "base/vector_path.h"
#include "mesh/mass_properties.h"
#include "simulation/small_scene.h"
#include "simulation/world_state.h"

namespace brisance {
namespace {
std::string checkpointOf(const World& world) {
  std::ostringstream out(std::ios_base::binary);
  world.checkpoint(out);
  return std::move(out).str();
}

using namespace test;

/// A ball of 5 pieces around the charge, which swells until it is released in the middle of the fourth frame.
SimulationSettings swellingScene() {
  SimulationSettings s = smallScene();
  BodySettings balloon;
  balloon.name = "balloon";
  balloon.shape = SphereShape{.22, 16};
  balloon.fracture.pieces = 5;
  balloon.pose = {{.5, .5, .35}, axisAngle({.6, .8, 0}, .4)};
  balloon.mass = MassGiven{.05};
  balloon.swells = true;
  balloon.releaseTime = 3.4 * s.frameTime;
  balloon.warmingTime = .01;
  s.bodies.back() = balloon;
  return s;
}

/// A pane that gives dust when it is released in the middle of the third frame, and a charge that throws sparks then.
SimulationSettings dustyScene() {
  SimulationSettings s = smallScene();
  s.particles.charges[1].time = 2.5 * s.frameTime;
  s.particles.charges[1].sparks = 30;
  s.bodies.back().releaseTime = 2.5 * s.frameTime;
  s.bodies.back().dust = 50;
  return s;
}

/// The same above a floor that the pieces land on.
SimulationSettings landingBalloon() {
  SimulationSettings s = swellingScene();
  s.rigid.collisions = Contacts{};
  s.rigid.gravity = {0, -40, 0};
  BodySettings floor = wallPart("floor", {-3, .1, -3}, {4, .2, 4});
  floor.blocksGas = false;
  s.bodies.push_back(floor);
  return s;
}

World worldAt(const SimulationSettings& settings, int frame) {
  World world(settings);
  while (world.frameIndex() < frame) world.advance();
  return world;
}

void expectSame(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.gas, b.gas);
  EXPECT_EQ(a.particles, b.particles);
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t n = 0; n < a.bodies.size(); ++n) {
    EXPECT_EQ(a.bodies[n].pose, b.bodies[n].pose);
    EXPECT_EQ(a.bodies[n].linearVelocity, b.bodies[n].linearVelocity);
    EXPECT_EQ(a.bodies[n].angularVelocity, b.bodies[n].angularVelocity);
    EXPECT_EQ(a.bodies[n].temperature, b.bodies[n].temperature);
    EXPECT_EQ(a.bodies[n].shapeFrame, b.bodies[n].shapeFrame);
    EXPECT_EQ(a.bodies[n].mesh->vertices, b.bodies[n].mesh->vertices);
  }
}

TEST(World, TheFirstFrameShowsThePaneWholeAndAtRest) {
  const Frame frame = World(smallScene()).capture();
  EXPECT_EQ(frame.index, 1);
  double volume = 0;
  Box3 around;
  int pieces = 0;
  for (const FrameBody& body : frame.bodies) {
    if (!body.moves) continue;
    ++pieces;
    EXPECT_EQ(body.linearVelocity, Vec3d());
    volume += solidProperties(*body.mesh).volume;
    for (const Vec3d& v : body.mesh->vertices) around.include(body.pose * v);
  }
  EXPECT_EQ(pieces, 6);
  EXPECT_NEAR(volume, .3 * .4 * .005, 1e-9);
  EXPECT_LT(length(around.size() - Vec3d(.3, .4, .005)), 1e-9);
  EXPECT_LT(length((around.lower + around.upper) * .5 - Vec3d(.5, .5, .65)), 1e-9);
}

TEST(World, TheExplosionDrivesThePiecesOutOfTheWindow) {
  const Frame frame = worldAt(smallScene(), 12).capture();
  for (const FrameBody& body : frame.bodies) {
    if (body.moves) {
      EXPECT_GT(body.pose.position.z, .65 + .005) << body.name;  // at least its own thickness
    } else {
      EXPECT_EQ(body.linearVelocity, Vec3d());
    }
  }
}

TEST(World, ItsBalancesClose) {
  for (const SimulationSettings& settings : {smallScene(), blockingScene()}) {
    const World world = worldAt(settings, 8);
    const RunTotals& totals = world.totals();
    EXPECT_GT(totals.volume.in, 0);
    EXPECT_LT(totals.volume.error(), 1e-3);
    EXPECT_GT(totals.heat.in, 0);
    EXPECT_LT(totals.heat.error(), 1e-3);
    EXPECT_LE(totals.courant, 1 + 1e-9);
  }
}

TEST(World, PressureDrivesPiecesThatBlockTheGasOutOfTheWindow) {
  SimulationSettings settings = blockingScene();
  settings.rigid.gravity = {};
  const Frame frame = worldAt(settings, 6).capture();
  for (const FrameBody& body : frame.bodies) {
    if (body.moves) {
      EXPECT_GT(body.linearVelocity.z, 0) << body.name;
      EXPECT_GT(body.pose.position.z, .65) << body.name;
    }
  }
}

TEST(World, GasStaysBehindAPaneThatBlocksItUntilThePaneGoes) {
  SimulationSettings settings = blockingScene();
  for (BodySettings& body : settings.bodies) body.releaseTime = 100;
  settings.particles.charges[1].position.z = .5;
  settings.fluid.startVelocity = 0;
  const World world = worldAt(settings, 4);
  const FrameGas gas = world.capture().gas;
  double behind = 0, before = 0;
  constexpr int paneLayer = 9;  // cells from here on have their centres in front of it
  for (const auto& brick : gas.temperature.bricks)
    forSamplesOf(brick.corner, gas.temperature.size,
                 [&](int n, int, int, int k) { (k < paneLayer ? behind : before) += std::abs(brick.values[n] - 300); });
  EXPECT_GT(behind, 1e3);
  EXPECT_LT(before, 1e-6 * behind);
}

TEST(World, StoppedBetweenSubStepsItGoesOnAsIfNeverStopped) {
  for (SimulationSettings settings : {blockingScene(), landingBalloon()}) {
    settings.fluid.courant = .2;  // several sub-steps a frame
    World undisturbed(settings), stopped(settings);
    int stops = 0;
    for (int frame = 2; frame <= 5; ++frame) {
      undisturbed.advance();
      int asked = 0;
      while (!stopped.advance([&] { return ++asked % 3 == 0; })) {
        ++stops;
        EXPECT_EQ(stopped.frameIndex(), frame - 1);
        EXPECT_THROW(checkpointOf(stopped), std::logic_error);
      }
      EXPECT_EQ(stopped.frameIndex(), frame);
    }
    EXPECT_GT(stops, 4);
    expectSame(stopped.capture(), undisturbed.capture());
    EXPECT_EQ(checkpointOf(stopped), checkpointOf(undisturbed));
  }
}

TEST(World, RestoredFromACheckpointItGoesOnAsIfNeverStopped) {
  for (const SimulationSettings& settings :
       {smallScene(), blockingScene(), swellingScene(), landingScene(), landingBalloon(), dustyScene()}) {
    const Frame undisturbed = worldAt(settings, 8).capture();
    for (const int stop : {2, 4, 7}) {
      const std::string bytes = checkpointOf(worldAt(settings, stop));
      World world(settings);
      world.restore(bytes, "test");
      EXPECT_EQ(world.frameIndex(), stop);
      while (world.frameIndex() < 8) world.advance();
      expectSame(world.capture(), undisturbed);
    }
  }
}

TEST(World, AnyThreadsAndVectorWidthGiveTheSameBits) {
  for (const SimulationSettings& settings :
       {smallScene(), blockingScene(), swellingScene(), landingScene(), landingBalloon(), dustyScene()}) {
    std::vector<Frame> frames;
    for (const int threads : {1, 2, 3})
      for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
        const ThreadLimit limit(threads);
        forceVectorPath(path);
        frames.push_back(worldAt(settings, 6).capture());
      }
    for (const Frame& frame : frames) expectSame(frame, frames[0]);
  }
}

std::size_t countOf(const Frame& frame, FrameKind kind) {
  const auto& kinds = frame.particles.kind;
  return static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), static_cast<std::uint8_t>(kind)));
}

TEST(World, DustComesOffThePaneThatIsReleasedAndSparksWithTheirCharge) {
  const Frame before = worldAt(dustyScene(), 3).capture(), after = worldAt(dustyScene(), 4).capture();
  EXPECT_EQ(countOf(before, FrameKind::dust) + countOf(before, FrameKind::spark), 0u);
  EXPECT_EQ(countOf(after, FrameKind::dust), 50u);
  EXPECT_GT(countOf(after, FrameKind::spark), 0u);
  for (std::size_t p = 0; p < after.particles.kind.size(); ++p)
    if (after.particles.kind[p] == static_cast<std::uint8_t>(FrameKind::dust)) {
      EXPECT_LT(std::abs(after.particles.position[p].x - .5f), .25f);
      EXPECT_LT(std::abs(after.particles.position[p].y - .5f), .3f);
    }
}

double spanOf(const Frame& frame) {
  Box3 around;
  for (const FrameBody& body : frame.bodies)
    if (body.moves)
      for (const Vec3d& v : body.mesh->vertices) around.include(body.pose * v);
  return length(around.size());
}

TEST(World, ABalloonSwellsWithItsPiecesTogetherAndThenTheyFly) {
  const SimulationSettings settings = swellingScene();
  World world(settings);
  const Frame start = world.capture();
  double span = spanOf(start);
  while (world.frameIndex() < 4) {
    world.advance();
    const double now = spanOf(world.capture());
    EXPECT_GT(now, span);
    span = now;
  }
  const Frame swollen = world.capture();  // frame 4 is at 3 frame times: still one body
  std::vector<Vec3d> places;
  for (const FrameBody& body : swollen.bodies) {
    if (!body.moves) continue;
    EXPECT_EQ(body.shapeFrame, 4);
    EXPECT_EQ(body.linearVelocity, Vec3d());
    for (const Vec3d& v : body.mesh->vertices) places.push_back(body.pose * v);
  }
  const auto apart = [](const std::vector<Vec3d>& points) {  // vertices that two pieces share are in two meshes
    std::size_t alone = 0;
    for (const Vec3d& p : points)
      alone += std::count_if(points.begin(), points.end(), [&](const Vec3d& q) { return length(p - q) < 1e-9; }) == 1;
    return alone;
  };
  std::vector<Vec3d> atRest;
  for (const FrameBody& body : start.bodies)
    if (body.moves)
      for (const Vec3d& v : body.mesh->vertices) atRest.push_back(body.pose * v);
  EXPECT_EQ(apart(places), apart(atRest));
  while (world.frameIndex() < 8) world.advance();
  const Frame flying = world.capture();
  double hottest = 0;
  for (const FrameBody& body : flying.bodies) {
    if (!body.moves) continue;
    EXPECT_LE(body.shapeFrame, 6);  // one that a sub-step ends in after the release
    EXPECT_GT(length(body.linearVelocity), 0);
    hottest = std::max(hottest, body.temperature);
  }
  EXPECT_GT(spanOf(flying), span);
  EXPECT_GT(hottest, 301);
}

TEST(World, AnotherSeedGivesAnotherExplosion) {
  SimulationSettings settings = smallScene();
  const Frame first = worldAt(settings, 3).capture();
  settings.seed = 2;
  EXPECT_FALSE(worldAt(settings, 3).capture().particles == first.particles);
}

TEST(World, PiecesThatCollideComeToLieOnTheFloor) {
  SimulationSettings settings = landingScene();
  settings.frames = 80;
  const Frame landing = worldAt(settings, 8).capture(), frame = worldAt(settings, 80).capture();
  double fastest = 0, deepest = 0;
  for (const FrameBody& body : landing.bodies) fastest = std::max(fastest, length(body.linearVelocity));
  EXPECT_GT(fastest, .1) << "a checkpoint of frame 7 is taken in the middle of contact";
  for (const FrameBody& body : frame.bodies) {
    if (!body.moves) continue;
    EXPECT_LT(length(body.linearVelocity), 1e-3) << body.name;
    for (const Vec3d& v : body.mesh->vertices) deepest = std::min(deepest, (body.pose * v).y);
  }
  EXPECT_GT(deepest, -5e-5);
}

TEST(World, PiecesRestUntilTheyAreReleased) {
  SimulationSettings settings = smallScene();
  settings.bodies.back().releaseTime = 4.5 * settings.frameTime;
  const Frame held = worldAt(settings, 5).capture(), free = worldAt(settings, 8).capture();
  for (const FrameBody& body : held.bodies) EXPECT_EQ(body.linearVelocity, Vec3d()) << body.name;
  EXPECT_GT(free.bodies.back().linearVelocity.z, 0);
}

TEST(World, ACheckpointThatLiesIsRefused) {
  World world(smallScene());
  const std::string bytes = checkpointOf(world);
  SimulationSettings other = smallScene();
  other.fluid.cells = {12, 14, 14};
  World smaller(other);
  EXPECT_THROW(smaller.restore(bytes, "test"), DamagedFile);
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{100}, bytes.size() - 1})
    EXPECT_THROW(world.restore(bytes.substr(0, size), "test"), DamagedFile) << size;
  EXPECT_THROW(world.restore("x" + bytes, "test"), DamagedFile);
  EXPECT_THROW(world.restore(bytes + "x", "test"), DamagedFile);
}

TEST(World, ParticlesStayBelowThePrediction) {
  const SimulationSettings settings = smallScene();
  const Frame frame = worldAt(settings, 8).capture();
  EXPECT_GT(frame.particles.kind.size(), 300u);
  EXPECT_LE(static_cast<std::int64_t>(frame.particles.kind.size()), predictedParticles(settings));
}

TEST(World, GasThatIsTooFastStopsTheRunWithOneLine) {
  SimulationSettings settings = smallScene();
  settings.particles.burning.gasPerMass = 1e6;
  settings.fluid.maxSubsteps = 20;
  World world(settings);
  try {
    while (world.frameIndex() < 8) world.advance();
    FAIL() << "ran";
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ExitCode::unstable);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace brisance
