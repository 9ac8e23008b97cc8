#include "mesh/convex_parts.h"

#include "mesh/convex_hull.h"
#include "mesh/mass_properties.h"

namespace brisance {
namespace {

using Corners = std::array<Vec3d, 3>;
using Soup = std::vector<Corners>;

std::vector<Vec3d> pointsOf(const Soup& soup) {
  std::vector<Vec3d> points;
  for (const Corners& t : soup) points.insert(points.end(), t.begin(), t.end());
  const auto less = [](const Vec3d& a, const Vec3d& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

double hullVolume(const std::vector<Vec3d>& points) {
  return points.size() < 4 ? 0 : std::abs(solidProperties(convexHull(points)).volume);
}

/// What of the soup lies on one side of a plane across an axis; `side` is 1 for above, -1 for below.
Soup clipped(const Soup& soup, int axis, double where, double side) {
  Soup result;
  for (const Corners& t : soup) {
    std::vector<Vec3d> polygon;
    for (int k = 0; k < 3; ++k) {
      const Vec3d &p = t[k], &q = t[(k + 1) % 3];
      const double hp = side * (p[axis] - where), hq = side * (q[axis] - where);
      if (hp >= 0) polygon.push_back(p);
      if (hp * hq >= 0) continue;
      Vec3d cut = p + (q - p) * (hp / (hp - hq));
      cut[axis] = where;
      polygon.push_back(cut);
    }
    for (std::size_t k = 2; k < polygon.size(); ++k) result.push_back({polygon[0], polygon[k - 1], polygon[k]});
  }
  return result;
}

struct Halved {
  Soup below, above;
  double volume = 0;  ///< [m3] of both hulls
};

/// A part with the best way to halve it.
struct Part {
  Soup soup;
  double volume = 0;  ///< [m3] of its hull
  Halved halved;
  double saved() const { return volume - halved.volume; }
};

Halved halve(const Soup& soup, int axis, double where) {
  Halved halves{clipped(soup, axis, where, -1), clipped(soup, axis, where, 1), 0};
  halves.volume = hullVolume(pointsOf(halves.below)) + hullVolume(pointsOf(halves.above));
  return halves;
}

Part partOf(Soup soup) {
  Part part{std::move(soup), 0, {}};
  const std::vector<Vec3d> points = pointsOf(part.soup);
  part.volume = hullVolume(points);
  part.halved.volume = part.volume;
  Box3 box;
  for (const Vec3d& p : points) box.include(p);
  for (int axis = 0; axis < 3; ++axis) {
    Halved halves = halve(part.soup, axis, (box.lower[axis] + box.upper[axis]) / 2);
    if (halves.volume < part.halved.volume) part.halved = std::move(halves);
  }
  return part;
}

Soup soupOf(const TriangleMesh& mesh) {
  Soup soup;
  for (const Triangle& t : mesh.triangles)
    soup.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  return soup;
}

/// Halves parts until they are `settings.most`, or tight: halving even the best of them saves nothing worth having.
std::vector<Part> divide(const TriangleMesh& mesh, double volume, const ConvexPartsSettings& settings) {
  constexpr double worthwhile = 0.005;  // of the volume
  std::vector<Part> parts{partOf(soupOf(mesh))};
  double covered = parts[0].volume;
  while (parts.size() < settings.most && covered > volume * (1 + settings.excess)) {
    const auto best = std::max_element(parts.begin(), parts.end(),
                                       [](const Part& a, const Part& b) { return a.saved() < b.saved(); });
    if (best->saved() < worthwhile * covered) break;
    covered -= best->saved();
    Soup above = std::move(best->halved.above), below = std::move(best->halved.below);
    *best = partOf(std::move(below));
    parts.push_back(partOf(std::move(above)));
  }
  return parts;
}

}  // namespace

std::vector<ConvexSolid> convexParts(const TriangleMesh& mesh, const ConvexPartsSettings& settings) {
  const double volume = std::abs(solidProperties(mesh).volume), whole = hullVolume(mesh.vertices);
  if (settings.most <= 1 || whole <= volume * (1 + settings.excess)) return {convexSolid(mesh.vertices)};
  std::vector<ConvexSolid> solids;
  for (const Part& part : divide(mesh, volume, settings)) {
    ConvexSolid solid = convexSolid(pointsOf(part.soup));
    if (!solid.faces.empty()) solids.push_back(std::move(solid));
  }
  return solids;
}

}  // namespace brisance
