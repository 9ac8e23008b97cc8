#include "rigid/movers.h"

#include "rigid/rigid_step.h"

namespace brisance {
namespace {

Mat3 outer(const Vec3d& a, const Vec3d& b) { return {{b * a.x, b * a.y, b * a.z}}; }

/// Sums over a group's members.
struct Gathered {
  double mass = 0;
  Vec3d firstMoment, momentum, angularMomentum;  ///< about the centre, once it is known
  Mat3 inertia = Mat3{} * 0;
};

std::uint32_t groupCount(const std::vector<std::uint32_t>& group) {
  return group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
}

}  // namespace

Movers makeMovers(const RigidBodies& bodies, const std::vector<std::uint32_t>& group, const std::vector<bool>& isFree) {
  Movers movers{std::vector<Mover>(groupCount(group)), group};
  std::vector<Gathered> sums(movers.of.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!isFree[b]) {
      movers.of[group[b]].place = bodies.position[b];
      continue;
    }
    const double mass = 1 / bodies.inverseMass[b];
    sums[group[b]].mass += mass;
    sums[group[b]].firstMoment += bodies.position[b] * mass;
    sums[group[b]].momentum += bodies.linearVelocity[b] * mass;
  }
  for (std::size_t g = 0; g < sums.size(); ++g) {
    if (sums[g].mass == 0) continue;
    movers.of[g].inverseMass = 1 / sums[g].mass;
    movers.of[g].place = sums[g].firstMoment / sums[g].mass;
    movers.of[g].velocity = sums[g].momentum / sums[g].mass;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!isFree[b]) continue;
    const double mass = 1 / bodies.inverseMass[b];
    const Vec3d arm = bodies.position[b] - movers.of[group[b]].place;
    const Mat3 own = worldInertia(bodies.inertia[b], bodies.orientation[b]);
    Gathered& sum = sums[group[b]];
    sum.inertia = sum.inertia + own + (Mat3{} * dot(arm, arm) + outer(arm, arm) * -1) * mass;
    sum.angularMomentum += own * bodies.angularVelocity[b] + cross(arm, bodies.linearVelocity[b] * mass);
  }
  for (std::size_t g = 0; g < sums.size(); ++g) {
    if (sums[g].mass == 0) continue;
    movers.of[g].inverseInertia = inverse(sums[g].inertia);
    movers.of[g].spin = movers.of[g].inverseInertia * sums[g].angularMomentum;
  }
  return movers;
}

void moveFor(Movers& movers, RigidBodies& bodies, const std::vector<Vec3d>& fall, double dt) {
  std::vector<Vec3d> before;
  for (std::size_t g = 0; g < movers.of.size(); ++g) {
    Mover& mover = movers.of[g];
    before.push_back(mover.place);
    if (mover.inverseMass == 0) continue;
    mover.place += mover.velocity * dt + fall[g];
    spinFreely(mover.turned, mover.spin, inverse(mover.inverseInertia), dt);
    const Mat3 turned = rotationMatrix(mover.turned);
    mover.inverseInertia = turned * mover.inverseInertia * transpose(turned);
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Mover& mover = movers.of[movers.number[b]];
    if (mover.inverseMass == 0) continue;
    bodies.position[b] = mover.place + rotate(mover.turned, bodies.position[b] - before[movers.number[b]]);
    bodies.orientation[b] = normalized(mover.turned * bodies.orientation[b]);
  }
}

void giveVelocities(const Movers& movers, const std::vector<bool>& isFree, RigidBodies& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!isFree[b]) continue;
    const Mover& mover = movers.of[movers.number[b]];
    bodies.linearVelocity[b] = velocityAt(mover, bodies.position[b] - mover.place);
    bodies.angularVelocity[b] = mover.spin;
  }
}

}  // namespace brisance
