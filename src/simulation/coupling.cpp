#include "simulation/coupling.h"

#include <algorithm>
#include <set>

#include "base/parallel.h"
#include "base/random.h"
#include "base/vector_path.h"
#include "grid/interpolate.h"
#include "particles/burning.h"
#include "particles/particle_step.h"
#include "rigid/contacts.h"
#include "rigid/swelling.h"

namespace brisance {

namespace {
/// Heat and expansion follow the fuel burnt; the largest expansion [1/s].
double spreadBurning(FluidState& gas, float heat, float expansion) {
  constexpr std::int64_t blockSize = 1 << 16;
  return parallelMax(gas.burnRate.count(), blockSize, [&](std::int64_t first, std::int64_t last) {
    float largest = 0;
    runWide([&] {
      for (std::int64_t n = first; n < last; ++n) {
        const float burning = gas.burnRate.values[n];
        gas.heatRate.values[n] = heat * burning;
        gas.divergence.values[n] = expansion * burning;
        largest = std::max(largest, expansion * burning);
      }
    });
    return static_cast<double>(largest);
  });
}
}  // namespace

void burnIntoGas(WorldState& world, const SimulationSettings& settings, double dt) {
  const BurnSettings& burning = settings.particles.burning;
  FluidState& gas = world.gas;
  burn(world.particles, burning, dt, world.burnt);
  depositBurnt(world.particles, world.burnt, burning, dt, gas.solid.inside, gas.burnRate, world.deposit);
  world.largestSource = spreadBurning(gas, static_cast<float>(burning.heatPerMass / settings.fluid.heatCapacity),
                                      static_cast<float>(burning.gasPerMass));
  world.burning = countBurning(world.particles);
  createSoot(world.particles, burning, gas.solid.inside, settings.seed);
  removeSpent(world.particles, burning, dt);
}

namespace {
/// Somewhere on a mesh; triangles count alike, whatever their size: most places lie where it is fine, at its cuts.
Vec3d somewhereOn(const TriangleMesh& mesh, const Random& random, std::uint64_t index) {
  const Triangle& t = mesh.triangles[random.below(mesh.triangles.size(), 3 * index)];
  double u = random.uniform(3 * index + 1), v = random.uniform(3 * index + 2);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return mesh.vertices[t[0]] * (1 - u - v) + mesh.vertices[t[1]] * u + mesh.vertices[t[2]] * v;
}

/// The pieces that a body of the scene was broken in.
std::vector<std::size_t> piecesOf(const RigidBodies& bodies, std::size_t origin) {
  std::vector<std::size_t> pieces;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies.origin[b] == origin) pieces.push_back(b);
  return pieces;
}

void giveDust(WorldState& world, const SimulationSettings& settings) {
  constexpr double spread = 0.4;  // [m/s]
  const RigidBodies& bodies = world.bodies;
  const Random random(settings.seed, Stream::dust);
  world.dust.given.resize(settings.bodies.size(), 0);
  for (std::size_t origin = 0; origin < settings.bodies.size(); ++origin) {
    const BodySettings& body = settings.bodies[origin];
    if (world.dust.given[origin] || body.dust == 0 || world.time < body.releaseTime) continue;
    world.dust.given[origin] = 1;
    const std::vector<std::size_t> pieces = piecesOf(bodies, origin);
    for (int n = 0; n < body.dust; ++n) {
      const std::uint64_t id = world.dust.particles.nextId;
      const std::size_t b = pieces[static_cast<std::size_t>(n) % pieces.size()];
      const Pose pose{bodies.position[b], bodies.orientation[b]};
      const Vec3d scatter(random.uniform(6 * id + 3) - .5, random.uniform(6 * id + 4) - .5,
                          random.uniform(6 * id + 5) - .5);
      addBit(world.dust, settings.particles.dust, pose * somewhereOn(*bodies.mesh[b], random, 2 * id),
             bodies.linearVelocity[b] + scatter * (2 * spread), body.temperature);
    }
  }
}
}  // namespace

void giveBits(WorldState& world, const SimulationSettings& settings) {
  throwSparks(world.sparks, settings.particles, world.time, settings.seed);
  giveDust(world, settings);
}

void carryParticles(WorldState& world, const SimulationSettings& settings, double dt) {
  GasAround around{world.gas.velocity, world.gas.temperature, world.gas.solid.openShare};
  for (int axis = 0; axis < 3; ++axis) around.periodic[axis] = isPeriodic(settings.fluid.faces, axis);
  around.empty = world.gas.solid.empty;
  stepParticles(world.particles, around, settings.particles.burning, dt);
  stepBits(world.sparks, around, settings.particles.sparks, settings.rigid.gravity, dt);
  stepBits(world.dust, around, settings.particles.dust, settings.rigid.gravity, dt);
}

namespace {
/// Bodies that have just become rigid touch their neighbours as pieces do at the start, and pass through them.
void collideAsTheyAre(WorldState& world, const std::vector<bool>& stiffened) {
  RigidBodies& bodies = world.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (stiffened[b]) world.shapes[b] = movingShape(*bodies.mesh[b]);
  std::set<BodyPair> passing(bodies.passing.begin(), bodies.passing.end());
  for (const BodyPair& pair : passingPairs(bodies, world.shapes))
    if (stiffened[pair.a] && stiffened[pair.b]) passing.insert(pair);
  bodies.passing.assign(passing.begin(), passing.end());
}
}  // namespace

void swellBodies(WorldState& world, double dt) {
  RigidBodies& bodies = world.bodies;
  std::vector<bool> stiffened(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    BodyLook& look = world.looks[b];
    if (!look.swelling) continue;
    look.shapeFrame = world.frame + 1;
    look.swelling = !bodies.isFree(b, world.time);
    const Pose pose{bodies.position[b], bodies.orientation[b]};
    stiffened[b] = !look.swelling;
    if (stiffened[b])
      stiffen(bodies, b, world.gas.velocity);
    else
      bodies.mesh[b] =
          std::make_shared<const TriangleMesh>(carriedByGas(*bodies.mesh[b], pose, world.gas.velocity, dt));
  }
  const bool any = std::find(stiffened.begin(), stiffened.end(), true) != stiffened.end();
  if (any && !world.shapes.empty()) collideAsTheyAre(world, stiffened);
}

void warmBodies(WorldState& world, double dt) {
  for (std::size_t b = 0; b < world.bodies.size(); ++b) {
    BodyLook& look = world.looks[b];
    if (!look.warmingTime) continue;
    const Pose pose{world.bodies.position[b], world.bodies.orientation[b]};
    double sum = 0;
    for (const Vec3d& vertex : world.bodies.mesh[b]->vertices) sum += interpolate(world.gas.temperature, pose * vertex);
    const double around = sum / static_cast<double>(world.bodies.mesh[b]->vertices.size());
    const double kept = *look.warmingTime > 0 ? portableExp(-dt / *look.warmingTime) : 0;
    look.temperature = around + (look.temperature - around) * kept;
  }
}

namespace {
/// Numbers of the bodies that may move, in the order of SolidStamp::bodies.
std::vector<std::size_t> movingBodies(const WorldState& world) {
  std::vector<std::size_t> numbers;
  for (std::size_t b = 0; b < world.bodies.size(); ++b)
    if (world.looks[b].moves) numbers.push_back(b);
  return numbers;
}
}  // namespace

void releaseBodies(WorldState& world, const SimulationSettings& settings) {
  if (!std::holds_alternative<Pressure>(settings.rigid.push)) return;
  const std::vector<std::size_t> numbers = movingBodies(world);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const std::size_t b = numbers[n];
    if (!world.bodies.isFree(b, world.time)) continue;
    MovingSolid& solid = world.gas.solid.bodies[n];
    solid.inverseMass = world.bodies.inverseMass[b];
    solid.inverseInertia = inverse(worldInertia(world.bodies.inertia[b], world.bodies.orientation[b]));
  }
}

void takePush(WorldState& world) {
  const std::vector<std::size_t> numbers = movingBodies(world);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const MovingSolid& solid = world.gas.solid.bodies[n];
    if (solid.inverseMass == 0) continue;
    world.bodies.linearVelocity[numbers[n]] = solid.velocity;
    world.bodies.angularVelocity[numbers[n]] = solid.angularVelocity;
  }
}

void blockGas(WorldState& world, const SimulationSettings& settings, bool anew) {
  const RigidBodies& b = world.bodies;
  std::vector<MovingSolid> solids;
  for (const std::size_t n : movingBodies(world)) {
    MovingSolid solid;
    solid.mesh = b.mesh[n];
    solid.pose = {b.position[n], b.orientation[n]};
    solid.velocity = b.linearVelocity[n];
    solid.angularVelocity = b.angularVelocity[n];
    solids.push_back(solid);
  }
  if (anew)
    world.stamper->stampMoving(solids, world.gas.solid);
  else
    moveSolids(world.gas, solids, settings.fluid, *world.stamper);
  world.limits.reset();
}

double expectedSource(const WorldState& world, const SimulationSettings& settings) {
  const std::size_t burning = countBurning(world.particles);
  if (burning == 0) return 0;
  const BurnSettings& b = settings.particles.burning;
  const double stacked = b.gasPerMass * largestDeposit(burning, b, settings.fluid.cellSize);
  if (world.burning == 0) return stacked;
  const double growth = static_cast<double>(burning) / static_cast<double>(world.burning);
  return std::min(stacked, world.largestSource * std::max(1.0, growth));
}

}  // namespace brisance
