#include "rigid/sleep.h"

#include <limits>

#include "base/disjoint_sets.h"

namespace brisance {
namespace {

constexpr double longEnough = 0.5;  // [s]
constexpr double nowhere = 0.02;    // of the radius: what the farthest point may move and be said to be in its place
constexpr double noticeable = 0.1;  // of the weight

void wake(RigidBodies& bodies, std::uint64_t heap) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies.rest[b].heap == heap) bodies.rest[b] = {bodies.position[b], bodies.orientation[b]};
}

/// How far the farthest point is from where it was [m].
double moved(const RigidBodies& bodies, std::size_t b, double radius) {
  const Quaternion turned = conjugate(bodies.rest[b].orientation) * bodies.orientation[b];
  const double sineOfHalf = std::min(1.0, length(Vec3d(turned.x, turned.y, turned.z)));
  return length(bodies.position[b] - bodies.rest[b].place) + 2 * std::asin(sineOfHalf) * radius;
}

void countRest(RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const std::vector<bool>& isAwake,
               double dt) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!isAwake[b]) continue;
    if (moved(bodies, b, shapes[b].radius) > nowhere * shapes[b].radius)
      bodies.rest[b] = {bodies.position[b], bodies.orientation[b]};
    else
      bodies.rest[b].duration += dt;
  }
}

/// What is known of a heap when it might fall asleep.
struct Heap {
  bool lies = false;  ///< on scenery, or on what is asleep
  bool rests = true;  ///< all of it for long enough, on nothing that will be released
  std::uint64_t number = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::uint64_t> under;  ///< heaps asleep that it lies on
};

bool isImmovable(const RigidBodies& bodies, std::uint32_t b) { return bodies.inverseMass[b] == 0; }

void addSupport(const RigidBodies& bodies, std::uint32_t other, Heap& heap) {
  if (isImmovable(bodies, other)) {
    heap.lies = true;
  } else if (const std::uint64_t number = bodies.rest[other].heap; number != 0) {
    heap.lies = true;
    heap.under.push_back(number);
    heap.number = std::min(heap.number, number);
  } else {
    heap.rests = false;  // held for the time being
  }
}

/// Per mover that stands for its heap.
std::vector<Heap> findHeaps(const RigidBodies& bodies, const Movers& movers, std::span<const ContactPoint> contacts,
                            const ContactSolver& solver, const std::vector<bool>& isAwake, DisjointSets& joined) {
  for (std::size_t n = 0; n < contacts.size(); ++n)
    if (solver.touches(n) && isAwake[contacts[n].a] && isAwake[contacts[n].b])
      joined.join(movers.number[contacts[n].a], movers.number[contacts[n].b]);
  std::vector<Heap> heaps(movers.of.size());
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    if (!isAwake[b]) continue;
    Heap& heap = heaps[joined.root(movers.number[b])];
    heap.rests = heap.rests && bodies.rest[b].duration >= longEnough;
    heap.number = std::min<std::uint64_t>(heap.number, b + 1);
  }
  for (std::size_t n = 0; n < contacts.size(); ++n) {
    const auto [awake, other] =
        isAwake[contacts[n].a] ? std::pair(contacts[n].a, contacts[n].b) : std::pair(contacts[n].b, contacts[n].a);
    if (solver.touches(n) && isAwake[awake] && !isAwake[other])
      addSupport(bodies, other, heaps[joined.root(movers.number[awake])]);
  }
  return heaps;
}

}  // namespace

std::vector<bool> awakeBodies(const RigidBodies& bodies, const std::vector<bool>& isFree) {
  std::vector<bool> isAwake(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) isAwake[b] = isFree[b] && bodies.rest[b].heap == 0;
  return isAwake;
}

void wakePushed(RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const Vec3d& gravity, double dt) {
  const double least = noticeable * length(gravity) * dt;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const double speed = length(bodies.linearVelocity[b]) + length(bodies.angularVelocity[b]) * shapes[b].radius;
    if (bodies.rest[b].heap != 0 && speed > least) wake(bodies, bodies.rest[b].heap);
  }
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies.rest[b].heap != 0) bodies.linearVelocity[b] = bodies.angularVelocity[b] = {};
}

bool wakeStruck(RigidBodies& bodies, std::span<const ContactPoint> contacts, const ContactSolver& solver,
                const std::vector<bool>& isAwake, const Vec3d& gravity, double dt) {
  std::vector<double> pushed(bodies.size(), 0);  // [kg m/s]
  for (std::size_t n = 0; n < contacts.size(); ++n)
    for (const auto& [body, by] : {std::pair(contacts[n].a, contacts[n].b), std::pair(contacts[n].b, contacts[n].a)})
      if (isAwake[by] && bodies.rest[body].heap != 0) pushed[body] += solver.strike(n);
  bool any = false;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies.rest[b].heap == 0 || pushed[b] * bodies.inverseMass[b] <= noticeable * length(gravity) * dt) continue;
    wake(bodies, bodies.rest[b].heap);
    any = true;
  }
  return any;
}

void fallAsleep(RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const Movers& movers,
                std::span<const ContactPoint> contacts, const ContactSolver& solver, const std::vector<bool>& isAwake,
                double dt) {
  countRest(bodies, shapes, isAwake, dt);
  DisjointSets joined(movers.of.size());
  const std::vector<Heap> heaps = findHeaps(bodies, movers, contacts, solver, isAwake, joined);
  const auto sleeps = [](const Heap& heap) { return heap.lies && heap.rests; };
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!isAwake[b]) continue;
    const Heap& heap = heaps[joined.root(movers.number[b])];
    if (!sleeps(heap)) continue;
    bodies.rest[b].heap = heap.number;
    bodies.linearVelocity[b] = bodies.angularVelocity[b] = {};
  }
  for (const Heap& heap : heaps)
    if (sleeps(heap))
      for (Rest& rest : bodies.rest)
        if (std::find(heap.under.begin(), heap.under.end(), rest.heap) != heap.under.end()) rest.heap = heap.number;
}

}  // namespace brisance
