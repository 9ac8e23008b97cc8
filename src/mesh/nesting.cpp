#include "mesh/nesting.h"

#include "mesh/box_tree.h"
#include "mesh/mesh_topology.h"
#include "mesh/self_crossing.h"

namespace brisance {
namespace {

constexpr std::size_t mostBoxes = 8'000'000;  // looked at, in all: a fraction of a second
/// Where a ray starts in a triangle, and the slopes of its way along x: such that it does not run within the planes or
/// through the edges of regularly made shapes.
constexpr double shareA = 0.537702, shareB = 0.291139, shareC = 1 - shareA - shareB;
constexpr double slopeY = 0.318713, slopeZ = 0.174617;

/// Six times the volume between each part and a corner of its own, far from which it would cancel to nothing.
std::vector<double> volumes(const TriangleMesh& surface, const std::vector<std::uint32_t>& partOf, std::size_t parts) {
  std::vector<double> volume(parts, 0);
  std::vector<std::uint32_t> origin(parts, noTriangle);
  for (std::size_t t = 0; t < partOf.size(); ++t) {
    if (partOf[t] == noTriangle) continue;
    const auto& [a, b, c] = surface.triangles[t];
    if (origin[partOf[t]] == noTriangle) origin[partOf[t]] = a;
    const Vec3d& o = surface.vertices[origin[partOf[t]]];
    volume[partOf[t]] += dot(surface.vertices[a] - o, cross(surface.vertices[b] - o, surface.vertices[c] - o));
  }
  return volume;
}

/// Twice the area of a, b, p seen along the rays: of opposite sign from either side of an edge, to the last bit.
double areaAlongRay(const Vec3d& a, const Vec3d& b, const Vec3d& p) {
  const Vec3d u = a - p, v = b - p;
  const double uy = u.y - slopeY * u.x, uz = u.z - slopeZ * u.x, vy = v.y - slopeY * v.x, vz = v.z - slopeZ * v.x;
  return uy * vz - uz * vy;
}

/// Whether the ray from p goes through the triangle.
bool isAhead(const TriangleMesh& surface, const Triangle& t, const Vec3d& p) {
  const Vec3d &q = surface.vertices[t[0]], &r = surface.vertices[t[1]], &s = surface.vertices[t[2]];
  const double c = areaAlongRay(q, r, p), a = areaAlongRay(r, s, p), b = areaAlongRay(s, q, p), sum = a + b + c;
  const bool around = (a >= 0 && b >= 0 && c >= 0) || (a < 0 && b < 0 && c < 0);
  return around && sum != 0 && (a * q.x + b * r.x + c * s.x) / sum > p.x;
}

/// Whether the ray from p meets the box.
bool meetsRay(const Box3& box, const Vec3d& p) {
  double from = std::max(0.0, box.lower.x - p.x), to = box.upper.x - p.x;
  from = std::max({from, (box.lower.y - p.y) / slopeY, (box.lower.z - p.z) / slopeZ});
  to = std::min({to, (box.upper.y - p.y) / slopeY, (box.upper.z - p.z) / slopeZ});
  return from <= to;
}

class Nesting {
 public:
  Nesting(const TriangleMesh& surface, const std::vector<std::uint32_t>& partOf) : surface_(surface), partOf_(partOf) {
    std::vector<Box3> boxes;
    for (std::uint32_t t = 0; t < partOf.size(); ++t) {
      if (partOf[t] == noTriangle) continue;
      triangles_.push_back(t);
      boxes.push_back(boxOf(surface, surface.triangles[t]));
    }
    tree_ = BoxTree(std::move(boxes));
  }

  /// Whether an odd number of other parts hold a part, of which `triangle` is one.
  bool isInside(std::uint32_t triangle) {
    const auto& [a, b, c] = surface_.triangles[triangle];
    const Vec3d p = surface_.vertices[a] * shareA + surface_.vertices[b] * shareB + surface_.vertices[c] * shareC;
    bool odd = false;  // crossings of all parts together: odd where an odd number of parts is crossed oddly
    looked_ +=
        tree_.search([&](const Box3& box) { return meetsRay(box, p); },
                     [&](std::uint32_t n) {
                       const std::uint32_t other = triangles_[n];
                       odd ^= partOf_[other] != partOf_[triangle] && isAhead(surface_, surface_.triangles[other], p);
                       return true;
                     });
    return odd;
  }
  bool isTired() const { return looked_ > mostBoxes; }

 private:
  const TriangleMesh& surface_;
  const std::vector<std::uint32_t>& partOf_;
  std::vector<std::uint32_t> triangles_;
  BoxTree tree_{{}};
  std::size_t looked_ = 0;
};

}  // namespace

Turning turningOf(const TriangleMesh& surface, const std::vector<std::uint32_t>& partOf, std::size_t parts) {
  Turning turning{std::vector<bool>(parts, false), std::vector<bool>(parts, false), true};
  std::vector<std::uint32_t> first(parts, noTriangle);
  for (std::uint32_t t = 0; t < partOf.size(); ++t)
    if (partOf[t] != noTriangle && first[partOf[t]] == noTriangle) first[partOf[t]] = t;
  if (parts > 1) {
    Nesting nesting(surface, partOf);
    for (std::size_t part = 0; part < parts && turning.judged; ++part) {
      if (first[part] != noTriangle) turning.inside[part] = nesting.isInside(first[part]);
      turning.judged = !nesting.isTired();
    }
    if (!turning.judged) turning.inside.assign(parts, false);
  }
  const std::vector<double> volume = volumes(surface, partOf, parts);
  for (std::size_t part = 0; part < parts; ++part)
    turning.turn[part] = first[part] != noTriangle && (turning.inside[part] ? volume[part] > 0 : volume[part] < 0);
  return turning;
}

}  // namespace brisance
