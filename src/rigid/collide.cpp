#include "rigid/collide.h"

#include "rigid/bonds.h"
#include "rigid/contacts.h"
#include "rigid/movers.h"
#include "rigid/rigid_step.h"
#include "rigid/sleep.h"

namespace brisance {
namespace {

/// The gap at which bodies rest, of the thinner one's thickness: small enough not to be seen, large enough for a
/// direction.
constexpr double skinShare = 5e-4;
/// Contacts are looked for at least this far, of a body's thickness.
constexpr double leastReach = 0.25;
constexpr int mostParts = 8;

std::vector<bool> freeBodies(const RigidBodies& bodies, double time) {
  std::vector<bool> isFree(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) isFree[b] = bodies.isFree(b, time);
  return isFree;
}

/// What the fastest point of a body may cover in dt [m].
double way(const RigidBodies& bodies, const CollisionShape& shape, std::size_t b, const Vec3d& gravity, double dt) {
  return (length(bodies.linearVelocity[b] + gravity * dt) + length(bodies.angularVelocity[b]) * shape.radius) * dt;
}

std::vector<double> reaches(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes,
                            const std::vector<bool>& isFree, const Vec3d& gravity, double dt) {
  std::vector<double> reach(bodies.size(), 0);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (isFree[b]) reach[b] = way(bodies, shapes[b], b, gravity, dt) + leastReach * shapes[b].thickness;
  return reach;
}

std::vector<BodyPair> withoutPassing(const std::vector<BodyPair>& pairs, const RigidBodies& bodies) {
  std::vector<BodyPair> rest;
  std::set_difference(pairs.begin(), pairs.end(), bodies.passing.begin(), bodies.passing.end(),
                      std::back_inserter(rest));
  return rest;
}

/// So many that no body near another one goes farther in a part than it is thick.
int partsOf(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const std::vector<bool>& isFree,
            const Vec3d& gravity, double dt) {
  double most = 1;
  const auto reach = reaches(bodies, shapes, isFree, gravity, dt);
  for (const auto& [a, b] : withoutPassing(nearPairs(bodies, shapes, reach, isFree), bodies))
    for (const std::uint32_t body : {a, b})
      if (isFree[body]) most = std::max(most, way(bodies, shapes[body], body, gravity, dt) / shapes[body].thickness);
  return static_cast<int>(std::ceil(std::min(most, static_cast<double>(mostParts))));
}

/// Contacts between movers, with the gap at which each rests.
struct Touching {
  std::vector<ContactPoint> contacts;
  std::vector<double> skin;
};

Touching findContacts(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes,
                      const std::vector<bool>& isFree, const std::vector<std::uint32_t>& group, const Vec3d& gravity,
                      double dt) {
  const std::vector<double> reach = reaches(bodies, shapes, isFree, gravity, dt);
  std::vector<BodyPair> pairs = withoutPassing(nearPairs(bodies, shapes, reach, isFree), bodies);
  std::erase_if(pairs, [&](const BodyPair& pair) { return group[pair.a] == group[pair.b]; });
  std::vector<double> together;
  together.reserve(pairs.size());
  for (const auto& [a, b] : pairs) together.push_back(reach[a] + reach[b]);
  Touching touching;
  for (const std::vector<ContactPoint>& found : contactsOf(bodies, shapes, pairs, together))
    for (const ContactPoint& contact : found) {
      touching.contacts.push_back(contact);
      touching.skin.push_back(skinShare * std::min(shapes[contact.a].thickness, shapes[contact.b].thickness));
    }
  return touching;
}

/// Which movers were pushed, and how far beyond their velocity at the end they fall: a body in free flight flies its
/// parabola, one that was pushed goes where its new velocity takes it.
std::vector<bool> pushed(const ContactSolver& solver, std::span<const ContactPoint> contacts, const Movers& movers) {
  std::vector<bool> is(movers.of.size(), false);
  for (std::size_t n = 0; n < solver.size(); ++n)
    if (!(solver.impulse(n) == Vec3d{})) is[movers.number[contacts[n].a]] = is[movers.number[contacts[n].b]] = true;
  return is;
}

std::vector<Vec3d> flight(const std::vector<bool>& isPushed, const Vec3d& gravity, double dt) {
  std::vector<Vec3d> fall;
  fall.reserve(isPushed.size());
  for (const bool is : isPushed) fall.push_back(is ? Vec3d{} : gravity * (-dt * dt / 2));
  return fall;
}

/// What lies still on something loses the rest of its motion to it.
void settle(Movers& movers, const std::vector<bool>& isPushed, const RigidBodies& bodies,
            const std::vector<CollisionShape>& shapes, double dt) {
  constexpr double slow = 0.05;  // [m/s] of the fastest point
  constexpr double rate = 20;    // [1/s]
  std::vector<double> radius(movers.of.size(), 0);
  for (std::size_t b = 0; b < shapes.size(); ++b) {
    const double reach = length(bodies.position[b] - movers.of[movers.number[b]].place) + shapes[b].radius;
    radius[movers.number[b]] = std::max(radius[movers.number[b]], reach);
  }
  for (std::size_t m = 0; m < movers.of.size(); ++m) {
    Mover& mover = movers.of[m];
    if (!isPushed[m] || length(mover.velocity) + length(mover.spin) * radius[m] > slow) continue;
    mover.velocity *= 1 / (1 + rate * dt);
    mover.spin *= 1 / (1 + rate * dt);
  }
}

/// Starts each contact from what pressed there, or nearly there, a step ago.
void beginAsBefore(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes,
                   std::span<const ContactPoint> contacts, double dt, ContactSolver& solver) {
  constexpr double nearly = 0.1;  // of the thickness
  std::vector<bool> used(bodies.pressing.size(), false);
  std::size_t first = 0;  // both lists are in the order of pairs
  for (std::size_t n = 0; n < contacts.size(); ++n) {
    const BodyPair pair{contacts[n].a, contacts[n].b};
    const auto before = [](const BodyPair& p, const BodyPair& q) {
      return std::minmax(p.a, p.b) < std::minmax(q.a, q.b);
    };
    while (first < bodies.pressing.size() && before(bodies.pressing[first].pair, pair)) ++first;
    const double least = nearly * std::min(shapes[pair.a].thickness, shapes[pair.b].thickness);
    for (std::size_t m = first; m < bodies.pressing.size() && bodies.pressing[m].pair == pair; ++m) {
      if (used[m] || length(bodies.pressing[m].place - contacts[n].place) > least) continue;
      solver.begin(n, bodies.pressing[m].force * dt);
      used[m] = true;
      break;
    }
  }
}

void rememberForces(const ContactSolver& solver, std::span<const ContactPoint> contacts, double dt,
                    RigidBodies& bodies) {
  bodies.pressing.clear();
  for (std::size_t n = 0; n < contacts.size(); ++n)
    if (const Vec3d impulse = solver.impulse(n); !(impulse == Vec3d{}))
      bodies.pressing.push_back({{contacts[n].a, contacts[n].b}, contacts[n].place, impulse / dt});
}

/// What each body would do without bonds, to be compared with what it does.
struct Unbonded {
  std::vector<Vec3d> velocity, spin;   ///< with gravity and contacts
  std::vector<Vec3d> angularMomentum;  ///< about the own centre of mass [kg m2/s]
};

Unbonded withoutBonds(const RigidBodies& bodies, const Touching& touching, const ContactSolver& solver,
                      const std::vector<Vec3d>& places, const Unbonded& before) {
  Unbonded alone = before;
  for (std::size_t n = 0; n < solver.size(); ++n) {
    const ContactPoint& contact = touching.contacts[n];
    for (const auto& [body, sign] : {std::pair{contact.a, -1.0}, std::pair{contact.b, 1.0}}) {
      const Vec3d impulse = solver.impulse(n) * sign;
      alone.velocity[body] += impulse * bodies.inverseMass[body];
      alone.angularMomentum[body] += cross(contact.place - places[body], impulse);
    }
  }
  return alone;
}

Unbonded beforeContacts(const RigidBodies& bodies, const std::vector<bool>& isFree, const Vec3d& gravity, double dt) {
  Unbonded alone{bodies.linearVelocity, bodies.angularVelocity, {}};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (isFree[b]) alone.velocity[b] += gravity * dt;
    alone.angularMomentum.push_back(worldInertia(bodies.inertia[b], bodies.orientation[b]) * alone.spin[b]);
  }
  return alone;
}

/// Loads that leave every group's motion as it is: rounding and turning within the step leave a little.
void balance(const RigidBodies& bodies, const std::vector<std::uint32_t>& group, const std::vector<bool>& isFree,
             std::vector<Load>& loads) {
  RigidBodies rest = bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    rest.linearVelocity[b] = loads[b].push * bodies.inverseMass[b];
    rest.angularVelocity[b] =
        isFree[b] ? inverse(worldInertia(bodies.inertia[b], bodies.orientation[b])) * loads[b].twist : Vec3d{};
  }
  const Movers movers = makeMovers(rest, group, isFree);
  giveVelocities(movers, isFree, rest);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!isFree[b]) continue;
    loads[b].push -= rest.linearVelocity[b] / bodies.inverseMass[b];
    loads[b].twist -= worldInertia(bodies.inertia[b], bodies.orientation[b]) * rest.angularVelocity[b];
  }
}

std::vector<Load> loadsOn(const RigidBodies& bodies, const std::vector<std::uint32_t>& group,
                          const std::vector<bool>& isFree, const Unbonded& alone) {
  std::vector<Load> loads(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!isFree[b]) continue;
    const Mat3 inertia = worldInertia(bodies.inertia[b], bodies.orientation[b]);
    loads[b].push = (alone.velocity[b] - bodies.linearVelocity[b]) / bodies.inverseMass[b];
    loads[b].twist = alone.angularMomentum[b] - inertia * bodies.angularVelocity[b];
  }
  balance(bodies, group, isFree, loads);
  return loads;
}

/// Members of groups that came apart have the momentum that they would have had without the bonds that broke.
void partGroups(const std::vector<std::uint32_t>& before, const std::vector<std::uint32_t>& after,
                const std::vector<bool>& isFree, const Unbonded& alone, RigidBodies& bodies) {
  std::vector<bool> parted(bodies.size(), false);
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    const auto first = static_cast<std::size_t>(std::find(before.begin(), before.end(), before[b]) - before.begin());
    if (after[b] != after[first]) parted[before[b]] = true;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!isFree[b] || !parted[before[b]]) continue;
    bodies.linearVelocity[b] = alone.velocity[b];
    bodies.angularVelocity[b] =
        inverse(worldInertia(bodies.inertia[b], bodies.orientation[b])) * alone.angularMomentum[b];
  }
  giveVelocities(makeMovers(bodies, after, isFree), isFree, bodies);
}

/// Bonds break under their loads, and those that are left under what they have to carry then.
void breakBonds(const std::vector<bool>& isFree, const Unbonded& alone, double dt, RigidBodies& bodies) {
  constexpr int oneByOne = 8, mostRounds = 16;
  std::vector<std::uint32_t> group = bondedGroups(bodies);
  for (int n = 0; n < mostRounds; ++n) {
    const Overloaded which = n < oneByOne ? Overloaded::worst : Overloaded::all;
    if (!loosenBonds(bodies, loadsOn(bodies, group, isFree, alone), dt, which)) return;
    const std::vector<std::uint32_t> parted = bondedGroups(bodies);
    partGroups(group, parted, isFree, alone, bodies);
    group = parted;
  }
}

/// One part of a step. Where it would strike what sleeps, it wakes that, does nothing else and says no: to be asked
/// again.
bool stepPart(RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const RigidSettings& settings,
              const std::vector<bool>& isFree, double dt) {
  const std::vector<bool> moves = awakeBodies(bodies, isFree);
  const std::vector<std::uint32_t> group = bondedGroups(bodies);
  const Contacts* law = std::get_if<Contacts>(&settings.collisions);
  Touching touching;
  if (law != nullptr) touching = findContacts(bodies, shapes, moves, group, settings.gravity, dt);
  Movers movers = makeMovers(bodies, group, moves);
  for (Mover& mover : movers.of)
    if (mover.inverseMass > 0) mover.velocity += settings.gravity * dt;
  ContactSolver solver(movers.of, movers.number, touching.contacts, touching.skin, law ? *law : Contacts{}, dt);
  beginAsBefore(bodies, shapes, touching.contacts, dt, solver);
  solver.solve();
  if (wakeStruck(bodies, touching.contacts, solver, moves, settings.gravity, dt)) return false;
  const Unbonded before = beforeContacts(bodies, moves, settings.gravity, dt);
  const std::vector<Vec3d> places = bodies.position;
  const std::vector<bool> isPushed = pushed(solver, touching.contacts, movers);
  moveFor(movers, bodies, flight(isPushed, settings.gravity, dt), dt);
  solver.relax();
  rememberForces(solver, touching.contacts, dt, bodies);
  constexpr double leastBounce = 0.02;  // [m/s]
  solver.bounce(leastBounce + 2 * length(settings.gravity) * dt);
  if (!(settings.gravity == Vec3d{})) settle(movers, isPushed, bodies, shapes, dt);
  giveVelocities(movers, moves, bodies);
  const bool anyHolds = std::any_of(bodies.holds.begin(), bodies.holds.end(), [](std::uint8_t h) { return h != 0; });
  if (anyHolds) breakBonds(moves, withoutBonds(bodies, touching, solver, places, before), dt, bodies);
  if (!(settings.gravity == Vec3d{})) fallAsleep(bodies, shapes, movers, touching.contacts, solver, moves, dt);
  return true;
}

}  // namespace

void stepColliding(RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const RigidSettings& settings,
                   double time, double dt) {
  const std::vector<bool> isFree = freeBodies(bodies, time);
  if (std::none_of(isFree.begin(), isFree.end(), [](bool is) { return is; })) return;
  bodies.rest.resize(bodies.size());
  wakePushed(bodies, shapes, settings.gravity, dt);
  int parts = 1;
  if (std::holds_alternative<Contacts>(settings.collisions)) {
    const std::vector<bool> moves = awakeBodies(bodies, isFree);
    forgetPassed(bodies, shapes, moves);
    parts = partsOf(bodies, shapes, moves, settings.gravity, dt);
  }
  for (int n = 0; n < parts; ++n)
    while (!stepPart(bodies, shapes, settings, isFree, dt / parts)) {
    }
}

}  // namespace brisance
