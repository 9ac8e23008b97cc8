#include "mesh/convex_solid.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "mesh/convex_hull.h"

namespace brisance {
namespace {

/// Two vectors that make a right-handed frame with a unit normal.
std::pair<Vec3d, Vec3d> tangents(const Vec3d& normal) {
  const Vec3d other = std::abs(normal.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  const Vec3d u = normalized(cross(other, normal));
  return {u, cross(normal, u)};
}

struct FlatPoint {
  double u, v;
  std::uint32_t number;
};

double turn(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/// Andrew's monotone chain: the corners of the outline, counter-clockwise; points on its sides are left out.
std::vector<std::uint32_t> outlineOf(std::vector<FlatPoint> points, double flat) {
  std::sort(points.begin(), points.end(), [](const FlatPoint& a, const FlatPoint& b) {
    return a.u != b.u ? a.u < b.u : a.v != b.v ? a.v < b.v : a.number < b.number;
  });
  std::vector<FlatPoint> chain;
  const auto add = [&](const FlatPoint& p, std::size_t least) {
    while (chain.size() >= least + 2 && turn(chain[chain.size() - 2], chain.back(), p) <= flat) chain.pop_back();
    chain.push_back(p);
  };
  for (const FlatPoint& p : points) add(p, 0);
  const std::size_t lower = chain.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  chain.pop_back();
  std::vector<std::uint32_t> numbers;
  numbers.reserve(chain.size());
  for (const FlatPoint& p : chain) numbers.push_back(p.number);
  return numbers;
}

/// All points within `slack` [m] of the plane through `origin`, as a polygon.
ConvexFace faceIn(const std::vector<Vec3d>& points, const Vec3d& normal, const Vec3d& origin, double slack) {
  const auto [u, v] = tangents(normal);
  std::vector<FlatPoint> flat;
  for (std::uint32_t n = 0; n < points.size(); ++n)
    if (std::abs(dot(points[n] - origin, normal)) <= slack) flat.push_back({dot(points[n], u), dot(points[n], v), n});
  return {normal, outlineOf(std::move(flat), slack * slack)};
}

double largest(const Vec3d& size) { return std::max({size.x, size.y, size.z}); }

bool isNew(const ConvexFace& face, const std::vector<ConvexFace>& faces) {
  constexpr double sameDirection = 1 - 1e-9;
  return std::none_of(faces.begin(), faces.end(), [&](const ConvexFace& other) {
    return dot(face.normal, other.normal) > sameDirection || face.corners == other.corners;
  });
}

/// Each place once, in the order in which places first come.
std::vector<Vec3d> withoutDuplicates(const std::vector<Vec3d>& points) {
  std::vector<Vec3d> kept;
  std::set<std::array<double, 3>> seen;
  for (const Vec3d& p : points)
    if (seen.insert({p.x, p.y, p.z}).second) kept.push_back(p);
  return kept;
}

}  // namespace

ConvexSolid convexSolid(const std::vector<Vec3d>& points) {
  const TriangleMesh hull = convexHull(withoutDuplicates(points));
  ConvexSolid solid;
  solid.points = hull.vertices;
  if (solid.points.empty()) return solid;
  constexpr double flat = 1e-7, sliver = 1e-8;  // of the size, and of its square
  const double size = largest(bounds(hull).size());
  for (const Triangle& t : hull.triangles) {
    const Vec3d &a = hull.vertices[t[0]], &b = hull.vertices[t[1]], &c = hull.vertices[t[2]];
    const Vec3d area = cross(b - a, c - a);
    if (length(area) < sliver * size * size) continue;
    ConvexFace face = faceIn(solid.points, normalized(area), a, flat * size);
    if (face.corners.size() >= 3 && isNew(face, solid.faces)) solid.faces.push_back(std::move(face));
  }
  return solid;
}

ConvexSolid triangleSheet(const Vec3d& a, const Vec3d& b, const Vec3d& c, bool twoSided) {
  ConvexSolid sheet;
  sheet.points = {a, b, c};
  const Vec3d normal = normalized(cross(b - a, c - a));
  sheet.faces.push_back({normal, {0, 1, 2}});
  if (twoSided) sheet.faces.push_back({-normal, {0, 2, 1}});
  return sheet;
}

double thickness(const ConvexSolid& solid) {
  double least = largest(bounds(solid).size());
  for (const ConvexFace& face : solid.faces) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3d& p : solid.points) {
      low = std::min(low, dot(p, face.normal));
      high = std::max(high, dot(p, face.normal));
    }
    least = std::min(least, high - low);
  }
  return least;
}

Box3 bounds(const ConvexSolid& solid) {
  Box3 box;
  for (const Vec3d& p : solid.points) box.include(p);
  return box;
}

void place(const ConvexSolid& solid, const Pose& pose, ConvexSolid& placed) {
  const Mat3 turned = rotationMatrix(pose.orientation);
  placed.points.resize(solid.points.size());
  for (std::size_t n = 0; n < solid.points.size(); ++n) placed.points[n] = turned * solid.points[n] + pose.position;
  placed.faces.resize(solid.faces.size());
  for (std::size_t n = 0; n < solid.faces.size(); ++n) {
    placed.faces[n].normal = turned * solid.faces[n].normal;
    placed.faces[n].corners = solid.faces[n].corners;
  }
}

}  // namespace brisance
