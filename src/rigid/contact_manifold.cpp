#include "rigid/contact_manifold.h"

#include <limits>

#include "rigid/closest_points.h"

namespace brisance {
namespace {

/// A plane along a face of one of two solids, and how far the other one is from it.
struct FacePlane {
  double gap = -std::numeric_limits<double>::infinity();  ///< [m]
  const ConvexFace* face = nullptr;
};

double lowest(const std::vector<Vec3d>& points, const Vec3d& normal) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3d& p : points) least = std::min(least, dot(p, normal));
  return least;
}

/// The face of `a` that keeps `b` farthest away.
FacePlane widestGap(const ConvexSolid& a, const ConvexSolid& b) {
  FacePlane best;
  for (const ConvexFace& face : a.faces) {
    const double gap = lowest(b.points, face.normal) - dot(a.points[face.corners[0]], face.normal);
    if (gap > best.gap) best = {gap, &face};
  }
  return best;
}

/// The face that looks most against a direction.
const ConvexFace& facing(const ConvexSolid& solid, const Vec3d& direction) {
  return *std::min_element(solid.faces.begin(), solid.faces.end(), [&](const ConvexFace& p, const ConvexFace& q) {
    return dot(p.normal, direction) < dot(q.normal, direction);
  });
}

/// Sutherland and Hodgman: what of a polygon lies behind a plane.
std::vector<Vec3d> cutBehind(const std::vector<Vec3d>& polygon, const Vec3d& normal, double offset) {
  std::vector<Vec3d> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double hp = dot(p, normal) - offset, hq = dot(q, normal) - offset;
    if (hp <= 0) kept.push_back(p);
    if (hp * hq < 0) kept.push_back(p + (q - p) * (hp / (hp - hq)));
  }
  return kept;
}

/// The part of `other`'s opposite face that lies over a face.
std::vector<Vec3d> overFace(const ConvexSolid& solid, const ConvexFace& face, const ConvexSolid& other) {
  std::vector<Vec3d> polygon;
  for (const std::uint32_t corner : facing(other, face.normal).corners) polygon.push_back(other.points[corner]);
  for (std::size_t k = 0; k < face.corners.size() && !polygon.empty(); ++k) {
    const Vec3d &p = solid.points[face.corners[k]], &q = solid.points[face.corners[(k + 1) % face.corners.size()]];
    const Vec3d side = normalized(cross(q - p, face.normal));
    polygon = cutBehind(polygon, side, dot(p, side));
  }
  return polygon;
}

/// The corner farthest against a direction.
const Vec3d& farthestAgainst(const ConvexSolid& solid, const Vec3d& direction) {
  return *std::min_element(solid.points.begin(), solid.points.end(),
                           [&](const Vec3d& p, const Vec3d& q) { return dot(p, direction) < dot(q, direction); });
}

/// Contacts of a face with the other solid: its nearest corner, which need not be one of its opposite face, and the
/// part of that face that lies over this one. `sign` is 1 where the face is a's.
void meetFace(const ConvexSolid& solid, const ConvexFace& face, const ConvexSolid& other, double sign, double reach,
              std::vector<ContactPoint>& contacts) {
  const double offset = dot(solid.points[face.corners[0]], face.normal);
  const auto add = [&](const Vec3d& p) {
    const double gap = dot(p, face.normal) - offset;
    if (gap <= reach) contacts.push_back({0, 0, p - face.normal * (gap / 2), face.normal * sign, gap});
  };
  const Vec3d& nearest = farthestAgainst(other, face.normal);
  const std::vector<Vec3d> over = overFace(solid, face, other);
  if (std::find(over.begin(), over.end(), nearest) == over.end()) add(nearest);
  for (const Vec3d& p : over) add(p);
}

/// Whether the solids meet in a face: no other direction keeps them farther apart.
bool meetsInFace(const FacePlane& plane, double sign, const ClosestPoints& closest) {
  constexpr double along = 1 - 1e-6, slack = 0.02;
  if (closest.distance > 0) return dot(closest.normal, plane.face->normal) * sign > along;
  return closest.distance <= plane.gap + slack * std::abs(plane.gap);
}

/// Two solids that meet in an edge or a corner, where faces are almost as near: corners of what these share are
/// contacts along the same normal. One contact alone, now here, now there, lets thin plates rock on each other for
/// ever.
void meetAlong(const ClosestPoints& closest, const ConvexSolid& a, const ConvexSolid& b, double reach,
               std::vector<ContactPoint>& contacts) {
  constexpr double almost = 0.95;  // cosine of 18 degrees
  contacts.push_back({0, 0, (closest.onA + closest.onB) / 2.0, closest.normal, closest.distance});
  if (a.faces.empty() || b.faces.empty()) return;
  const ConvexFace& face = facing(a, closest.normal * -1.0);
  const double cosine = dot(face.normal, closest.normal);
  if (cosine < almost || dot(facing(b, closest.normal).normal, closest.normal) > -almost) return;
  const double offset = dot(a.points[face.corners[0]], face.normal);
  for (const Vec3d& p : overFace(a, face, b)) {
    const double gap = std::max((dot(p, face.normal) - offset) / cosine, closest.distance);
    if (gap <= reach) contacts.push_back({0, 0, p - closest.normal * (gap / 2), closest.normal, gap});
  }
}

}  // namespace

void touch(const ConvexSolid& a, const ConvexSolid& b, double reach, std::vector<ContactPoint>& contacts) {
  const FacePlane ofA = widestGap(a, b), ofB = widestGap(b, a);
  if (ofA.gap > reach || ofB.gap > reach) return;
  const double preferA = 1e-6 * reach;  // of two faces that are as good, always the same one
  const bool faceOfA = ofA.face != nullptr && (ofB.face == nullptr || ofA.gap >= ofB.gap - preferA);
  const FacePlane& plane = faceOfA ? ofA : ofB;
  const double sign = faceOfA ? 1 : -1;
  const auto closest = closestPoints(a.points, b.points);
  if (closest ? closest->distance > reach : plane.gap >= 0) return;
  const bool inFace = plane.face != nullptr && (!closest || meetsInFace(plane, sign, *closest));
  if (inFace)
    meetFace(faceOfA ? a : b, *plane.face, faceOfA ? b : a, sign, reach, contacts);
  else if (closest)
    meetAlong(*closest, a, b, reach, contacts);
}

void touch(const SurfaceTriangle& a, const ConvexSolid& b, double reach, std::vector<ContactPoint>& contacts) {
  const std::size_t before = contacts.size();
  touch(a.sheet, b, reach, contacts);
  constexpr double slack = 1e-3, backwards = 1e-6;
  const bool oneSided = a.sheet.faces.size() == 1;
  const double onEdge = 1e-6 * length(a.sheet.points[1] - a.sheet.points[0]);
  const auto foreign = [&](const ContactPoint& contact) {
    if (oneSided && dot(contact.normal, a.sheet.faces[0].normal) < backwards) return true;
    const Vec3d onSheet = contact.place - contact.normal * (contact.gap / 2);
    for (int k = 0; k < 3; ++k)
      if (dot(onSheet - a.sheet.points[k], a.outward[k]) > -onEdge &&
          dot(contact.normal, a.outward[k]) > a.leaning[k] + slack)
        return true;
    return false;
  };
  contacts.erase(std::remove_if(contacts.begin() + static_cast<std::ptrdiff_t>(before), contacts.end(), foreign),
                 contacts.end());
}

namespace {
constexpr int compass = 8;  // directions in which the outermost contact is kept

/// Of contacts with the first one's normal: the deepest, and the outermost in each direction of the compass.
std::vector<std::size_t> outermost(const std::vector<ContactPoint>& contacts, const std::vector<std::size_t>& group) {
  const Vec3d& normal = contacts[group[0]].normal;
  const Vec3d u = normalized(cross(std::abs(normal.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0), normal));
  const Vec3d v = cross(normal, u);
  std::vector<std::size_t> kept;
  const auto keepBest = [&](const auto& value) {
    kept.push_back(*std::max_element(group.begin(), group.end(), [&](std::size_t p, std::size_t q) {
      return value(contacts[p]) < value(contacts[q]);
    }));
  };
  keepBest([](const ContactPoint& c) { return -c.gap; });
  for (int k = 0; k < compass; ++k) {
    const SinCos angle = portableSinCos(2 * pi * k / compass);
    const Vec3d direction = u * angle.cos + v * angle.sin;
    keepBest([&](const ContactPoint& c) { return dot(c.place, direction); });
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}
}  // namespace

void reduceContacts(std::vector<ContactPoint>& contacts) {
  constexpr double nearlyOne = 0.9998;  // cosine of a degree
  if (contacts.size() <= 4) return;
  std::vector<ContactPoint> kept;
  std::vector<bool> done(contacts.size(), false);
  for (std::size_t first = 0; first < contacts.size(); ++first) {
    if (done[first]) continue;
    std::vector<std::size_t> group;
    for (std::size_t n = first; n < contacts.size(); ++n)
      if (!done[n] && dot(contacts[n].normal, contacts[first].normal) > nearlyOne) group.push_back(n), done[n] = true;
    for (const std::size_t n : outermost(contacts, group)) kept.push_back(contacts[n]);
  }
  contacts = std::move(kept);
}

}  // namespace brisance
