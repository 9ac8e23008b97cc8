#include "rigid/contacts.h"

#include "base/parallel.h"

namespace brisance {
namespace {

struct Grown {
  Box3 box;
  std::uint32_t body = 0;
};

void grow(Box3& box, double by) {
  box.lower -= Vec3d(by, by, by);
  box.upper += Vec3d(by, by, by);
}

Box3 boxOf(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes, std::size_t b) {
  if (bodies.inverseMass[b] == 0) return shapes[b].box;
  const double r = shapes[b].radius;
  return {bodies.position[b] - Vec3d(r, r, r), bodies.position[b] + Vec3d(r, r, r)};
}

/// A body's parts where they are now.
struct Placed {
  std::vector<ConvexSolid> parts;
  std::vector<Box3> boxes;
};

void placeShape(const CollisionShape& shape, const Pose& pose, Placed& placed) {
  placed.parts.resize(shape.parts.size());
  placed.boxes.resize(shape.parts.size());
  for (std::size_t n = 0; n < shape.parts.size(); ++n) {
    place(shape.parts[n], pose, placed.parts[n]);
    placed.boxes[n] = bounds(placed.parts[n]);
  }
}

std::vector<Placed> placeAll(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes,
                             std::span<const BodyPair> pairs) {
  std::vector<bool> needed(bodies.size(), false);
  for (const auto& [a, b] : pairs) needed[a] = needed[b] = true;
  std::vector<Placed> placed(bodies.size());
  parallelFor(0, static_cast<std::int64_t>(bodies.size()), 4, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n)
      if (needed[n]) placeShape(shapes[n], {bodies.position[n], bodies.orientation[n]}, placed[n]);
  });
  return placed;
}

void touchParts(const Placed& a, const Placed& b, double reach, std::vector<ContactPoint>& contacts) {
  for (std::size_t p = 0; p < a.parts.size(); ++p) {
    Box3 around = a.boxes[p];
    grow(around, reach);
    for (std::size_t q = 0; q < b.parts.size(); ++q)
      if (overlap(around, b.boxes[q])) touch(a.parts[p], b.parts[q], reach, contacts);
  }
}

void touchTriangles(const CollisionShape& scenery, const Placed& body, double reach,
                    std::vector<ContactPoint>& contacts) {
  for (std::size_t q = 0; q < body.parts.size(); ++q) {
    Box3 around = body.boxes[q];
    grow(around, reach);
    std::vector<std::uint32_t> met;
    scenery.tree->search([&](const Box3& box) { return overlap(box, around); },
                         [&](std::uint32_t triangle) {
                           met.push_back(triangle);
                           return true;
                         });
    std::sort(met.begin(), met.end());
    for (const std::uint32_t triangle : met) touch(scenery.triangles[triangle], body.parts[q], reach, contacts);
  }
}

std::vector<ContactPoint> touchPair(const BodyPair& pair, const std::vector<CollisionShape>& shapes,
                                    const std::vector<Placed>& placed, double reach) {
  std::vector<ContactPoint> contacts;
  const auto [a, b] = pair;
  const bool swapped = !shapes[b].triangles.empty();  // scenery of triangles comes first
  const auto first = swapped ? b : a, second = swapped ? a : b;
  if (!shapes[first].triangles.empty())
    touchTriangles(shapes[first], placed[second], reach, contacts);
  else
    touchParts(placed[first], placed[second], reach, contacts);
  for (ContactPoint& contact : contacts) contact.a = first, contact.b = second;
  reduceContacts(contacts);
  return contacts;
}

/// How far two bodies are apart when they have come clear of each other [m].
double clearance(const CollisionShape& a, const CollisionShape& b) {
  constexpr double share = 0.02;  // of the thickness
  return share * std::min(a.thickness, b.thickness);
}

bool startsTouching(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const BodyPair& pair,
                    const std::vector<ContactPoint>& contacts) {
  constexpr double overlapping = 0.01;  // of the thickness
  const double least = std::min(shapes[pair.a].thickness, shapes[pair.b].thickness);
  const bool pieces = bodies.origin[pair.a] == bodies.origin[pair.b];
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const ContactPoint& contact) { return pieces || contact.gap < -overlapping * least; });
}

}  // namespace

std::vector<BodyPair> nearPairs(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes,
                                std::span<const double> reach, const std::vector<bool>& isFree) {
  std::vector<Grown> boxes;
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    boxes.push_back({boxOf(bodies, shapes, b), b});
    grow(boxes.back().box, reach[b]);
  }
  std::sort(boxes.begin(), boxes.end(), [](const Grown& p, const Grown& q) {
    return p.box.lower.x != q.box.lower.x ? p.box.lower.x < q.box.lower.x : p.body < q.body;
  });
  std::vector<BodyPair> pairs;
  std::vector<std::size_t> open;  // boxes that reach beyond the sweep's x
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    std::erase_if(open, [&](std::size_t m) { return boxes[m].box.upper.x < boxes[n].box.lower.x; });
    for (const std::size_t m : open) {
      const std::uint32_t a = std::min(boxes[m].body, boxes[n].body), b = std::max(boxes[m].body, boxes[n].body);
      if ((isFree[a] || isFree[b]) && overlap(boxes[m].box, boxes[n].box)) pairs.push_back({a, b});
    }
    open.push_back(n);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<std::vector<ContactPoint>> contactsOf(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes,
                                                  std::span<const BodyPair> pairs, std::span<const double> reach) {
  const std::vector<Placed> placed = placeAll(bodies, shapes, pairs);
  std::vector<std::vector<ContactPoint>> found(pairs.size());
  parallelFor(0, static_cast<std::int64_t>(pairs.size()), 4, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) found[n] = touchPair(pairs[n], shapes, placed, reach[n]);
  });
  return found;
}

std::vector<BodyPair> passingPairs(const RigidBodies& bodies, const std::vector<CollisionShape>& shapes) {
  std::vector<double> grown(bodies.size(), 0), reach;
  std::vector<bool> moves(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    moves[b] = bodies.inverseMass[b] > 0;
    if (moves[b]) grown[b] = clearance(shapes[b], shapes[b]);
  }
  const std::vector<BodyPair> pairs = nearPairs(bodies, shapes, grown, moves);
  for (const auto& [a, b] : pairs) reach.push_back(clearance(shapes[a], shapes[b]));
  const auto contacts = contactsOf(bodies, shapes, pairs, reach);
  std::vector<BodyPair> passing;
  for (std::size_t n = 0; n < pairs.size(); ++n)
    if (startsTouching(bodies, shapes, pairs[n], contacts[n])) passing.push_back(pairs[n]);
  return passing;
}

void forgetPassed(RigidBodies& bodies, const std::vector<CollisionShape>& shapes, const std::vector<bool>& isFree) {
  std::vector<BodyPair> kept, looked;
  std::vector<double> reach;
  for (const BodyPair& pair : bodies.passing)
    if (isFree[pair.a] || isFree[pair.b]) {
      looked.push_back(pair);
      reach.push_back(clearance(shapes[pair.a], shapes[pair.b]));
    } else {
      kept.push_back(pair);
    }
  const auto contacts = contactsOf(bodies, shapes, looked, reach);
  for (std::size_t n = 0; n < looked.size(); ++n)
    if (!contacts[n].empty()) kept.push_back(looked[n]);
  std::sort(kept.begin(), kept.end());
  bodies.passing = std::move(kept);
}

}  // namespace brisance
