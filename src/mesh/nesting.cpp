#include "mesh/nesting.h"

#include "mesh/box_tree.h"
#include "mesh/mesh_topology.h"
#include "mesh/self_crossing.h"

namespace brisance {
namespace {

constexpr std::size_t mostBoxes = 100'000'000;  // looked at, in all
/// A point of a triangle that lies above no corner or edge of other, regularly made ones.
constexpr double shareA = 0.537702, shareB = 0.291139, shareC = 1 - shareA - shareB;

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

/// Twice the area of a, b, p seen along x; the same but for its sign from either side of the edge.
double areaAlongX(const TriangleMesh& surface, std::uint32_t a, std::uint32_t b, const Vec3d& p) {
  const bool swapped = a > b;
  const Vec3d u = surface.vertices[swapped ? b : a] - p, v = surface.vertices[swapped ? a : b] - p;
  const double area = u.y * v.z - u.z * v.y;
  return swapped ? -area : area;
}

/// Whether a ray from p along +x goes through the triangle.
bool isAhead(const TriangleMesh& surface, const Triangle& t, const Vec3d& p) {
  const double c = areaAlongX(surface, t[0], t[1], p), a = areaAlongX(surface, t[1], t[2], p),
               b = areaAlongX(surface, t[2], t[0], p);
  const bool around = (a >= 0 && b >= 0 && c >= 0) || (a < 0 && b < 0 && c < 0);
  if (!around || a + b + c == 0) return false;
  const double x = (a * surface.vertices[t[0]].x + b * surface.vertices[t[1]].x + c * surface.vertices[t[2]].x);
  return x / (a + b + c) > p.x;
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
    const auto meetsRay = [&](const Box3& box) {
      return box.upper.x >= p.x && box.lower.y <= p.y && box.upper.y >= p.y && box.lower.z <= p.z && box.upper.z >= p.z;
    };
    bool odd = false;  // crossings of all parts together: odd where an odd number of parts is crossed oddly
    looked_ += tree_.search(meetsRay, [&](std::uint32_t n) {
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
