#include "simulation/world.h"

#include <chrono>
#include <cmath>

#include "base/cancellation.h"
#include "fluid/solid_fractions.h"
#include "particles/burning.h"
#include "rigid/collide.h"
#include "rigid/contacts.h"
#include "rigid/gas_push.h"
#include "rigid/rigid_step.h"
#include "simulation/capture.h"
#include "simulation/checkpoint.h"
#include "simulation/coupling.h"
#include "simulation/make_bodies.h"
#include "simulation/world_state.h"

namespace brisance {

namespace {
/// Adds the seconds that `work` takes to a stage of the report.
template <class Work>
void timed(StepReport& report, const char* stage, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  report.stageSeconds[stage] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void record(const FluidReport& step, StepReport& report) {
  ++report.substeps;
  report.courant = std::max(report.courant, step.courant);
  report.divergence = std::max(report.divergence, step.divergence);
  report.pressure.iterations += step.pressure.iterations;
  report.pressure.residual = std::max(report.pressure.residual, step.pressure.residual);
  report.pressure.converged = report.pressure.converged && step.pressure.converged;
  report.pressure.sealedPockets = std::max(report.pressure.sealedPockets, step.pressure.sealedPockets);
  report.pressure.removedSource = std::max(report.pressure.removedSource, step.pressure.removedSource);
  report.volume += step.volume;
  report.heat += step.heat;
}

const StepLimits& limitsOfGas(WorldState& world) {
  if (!world.limits) world.limits = limitsOf(world.gas);
  return *world.limits;
}

void stepGas(WorldState& world, const SimulationSettings& s, double dt) {
  const FluidReport step =
      stepFluid(world.gas, s.fluid, s.particles.burning.sootPerMass, dt, world.scratch, limitsOfGas(world));
  world.limits = step.next;
  record(step, world.report);
}

/// burn; stepFluid; stepParticles; pushBodies; stepBodies; blockGas.
void substep(WorldState& world, const SimulationSettings& s, double dt) {
  StepReport& report = world.report;
  const bool block = s.bodiesInGas == BodiesInGas::block;
  timed(report, "burn", [&] { burnIntoGas(world, s, dt); });
  if (block) releaseBodies(world, s);
  timed(report, "gas", [&] { stepGas(world, s, dt); });
  timed(report, "particles", [&] { carryParticles(world, s, dt); });
  timed(report, "bodies", [&] {
    swellBodies(world, dt);
    warmBodies(world, dt);
    if (const auto* drag = std::get_if<Drag>(&s.rigid.push))
      pushBodies(world.bodies, world.gas.velocity, *drag, world.time, dt);
    else
      takePush(world);
    if (std::holds_alternative<Contacts>(s.rigid.collisions) || !world.bodies.bonds.empty())
      stepColliding(world.bodies, world.shapes, s.rigid, world.time, dt);
    else
      stepBodies(world.bodies, s.rigid, world.time, dt);
  });
  if (block) timed(report, "solids", [&] { blockGas(world, s, false); });
  world.time += dt;
  emitFuel(world.particles, s.particles, world.time, s.fluid.ambientTemperature, s.seed, world.emitted);
  giveBits(world, s);
}

std::string findNotFinite(const RigidBodies& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (!isFinite(bodies.position[b]) || !isFinite(bodies.linearVelocity[b]) || !isFinite(bodies.angularVelocity[b]))
      return fmt::format("motion of body {}", bodies.name[b]);
  return {};
}

void refuseBrokenState(const WorldState& world, const SimulationSettings& settings) {
  std::string place = findNotFinite(world.gas);
  if (place.empty()) place = findNotFinite(world.bodies);
  if (!place.empty())
    throw Error(ExitCode::unstable,
                fmt::format("frame {}, sub-step {}, time {:.4g} s: {} is not a finite number: lower gas.courant or "
                            "the explosion's heat and gas",
                            world.frame + 1, world.report.substeps, world.time, place));
  if (!world.report.pressure.converged)
    throw Error(ExitCode::unstable,
                fmt::format("frame {}, time {:.4g} s: pressure reached a residual of {:.2g} only: raise "
                            "gas.pressure.max_iterations or gas.pressure.tolerance",
                            world.frame + 1, world.time, world.report.pressure.residual));
  if (world.report.substeps >= settings.fluid.maxSubsteps)
    throw Error(ExitCode::unstable,
                fmt::format("frame {}, time {:.4g} s: {} sub-steps were not enough: gas is too fast; raise "
                            "gas.max_substeps or lower the explosion's heat and gas",
                            world.frame + 1, world.time, world.report.substeps));
}

void beginFrame(WorldState& world, const SimulationSettings& settings) {
  world.report = {};
  world.time = settings.frameTime * (world.frame - 1);
  world.inFrame = true;
  timed(world.report, "particles", [&] { sortByRow(world.particles, world.gas.burnRate, world.order); });
}

void addToTotals(const StepReport& report, RunTotals& totals) {
  totals.volume += report.volume;
  totals.heat += report.heat;
  totals.courant = std::max(totals.courant, report.courant);
  totals.divergence = std::max(totals.divergence, report.divergence);
  totals.substeps += report.substeps;
}
}  // namespace

World::World(SimulationSettings settings) : settings_(std::move(settings)), state_(std::make_unique<WorldState>()) {
  const std::vector<MovingSolid> solids = makeBodies(settings_, *state_);
  const bool collide = std::holds_alternative<Contacts>(settings_.rigid.collisions);
  if (collide || !state_->bodies.bonds.empty()) state_->shapes = collisionShapes(state_->bodies);
  if (collide) {
    state_->bodies.passing = passingPairs(state_->bodies, state_->shapes);
  }
  SolidStamper stamper(settings_.fluid, solids);
  state_->gas = makeFluid(settings_.fluid, stamper.fixed(), settings_.seed);
  if (settings_.bodiesInGas == BodiesInGas::block) {
    state_->stamper = std::move(stamper);
    blockGas(*state_, settings_, false);
  }
  emitFuel(state_->particles, settings_.particles, 0, settings_.fluid.ambientTemperature, settings_.seed,
           state_->emitted);
  giveBits(*state_, settings_);
}
World::~World() = default;
World::World(World&&) noexcept = default;

bool World::advance(const StopRequested& stopRequested) {
  WorldState& world = *state_;
  if (!world.inFrame) beginFrame(world, settings_);
  const double end = settings_.frameTime * world.frame, sliver = 1e-9 * settings_.frameTime;
  while (world.time < end - sliver) {
    if (stopRequested && stopRequested()) return false;
    const double longest =
        longestStep(world.gas, settings_.fluid, expectedSource(world, settings_), limitsOfGas(world));
    const double left = end - world.time;
    substep(world, settings_, left / std::ceil(left / std::min(longest, left)));
    refuseBrokenState(world, settings_);
  }
  world.time = end;
  world.inFrame = false;
  ++world.frame;
  addToTotals(world.report, world.totals);
  return true;
}

void World::advanceOrStay() {
  WorldMoment before = *state_;
  try {
    advance();
  } catch (const Interrupted&) {
    // Nothing of a later step depends on what the room for work has in it, but it may have been left half made.
    const CancellableWork undisturbed(nullptr);
    state_->scratch = {};
    state_->deposit = {};
    state_->order = {};
    static_cast<WorldMoment&>(*state_) = std::move(before);
    throw;
  }
}

Frame World::capture() const { return captureFrame(*state_, settings_); }

Frame World::captureWithoutGas() const { return brisance::captureWithoutGas(*state_); }

GasSource World::gas() const { return gasOf(*state_, settings_); }
int World::frameIndex() const { return state_->frame; }
const RunTotals& World::totals() const { return state_->totals; }
void World::checkpoint(std::ostream& out) const {
  CHECK(!state_->inFrame, "frame {}", state_->frame);
  writeCheckpoint(*state_, out);
}
void World::restore(const std::string& bytes, const std::string& fileName) {
  readCheckpoint(bytes, fileName, *state_);
  state_->inFrame = false;
  for (std::size_t b = 0; b < state_->shapes.size(); ++b)
    if (state_->looks[b].shapeFrame > 0) state_->shapes[b] = movingShape(*state_->bodies.mesh[b]);
  state_->limits.reset();
  if (state_->stamper) blockGas(*state_, settings_, true);
}

std::int64_t predictedParticles(const SimulationSettings& settings) {
  double count = 0;
  const BurnSettings& b = settings.particles.burning;
  const double end = settings.frames * settings.frameTime;
  for (const Charge& charge : settings.particles.charges) {
    if (charge.time > end) continue;
    count += charge.particles + charge.emissionRate * std::min(charge.emissionTime, end - charge.time);
  }
  const double sootPerFuel = b.sootOnce ? 1 : std::floor(b.mass * b.sootPerMass / b.sootThreshold);
  double bits = 0;
  for (const Charge& charge : settings.particles.charges) bits += charge.sparks;
  for (const BodySettings& body : settings.bodies) bits += body.dust;
  return static_cast<std::int64_t>(count * (1 + sootPerFuel) + bits);
}

}  // namespace brisance
