// Outlines and patterns that several tests look at, and questions about flat meshes.
#pragma once

#include <set>

#include "mesh/lattice_points.h"
#include "mesh/mesh_topology.h"
#include "mesh/triangulation.h"

namespace brisance {

inline Outline arrowOutline() { return PolygonOutline{{{0, 0}, {1, 0.1}, {1.1, 0.9}, {0.6, 0.35}, {0.1, 1}}}; }
/// A C: its two arms see nothing of one another.
inline Outline clampOutline() {
  return PolygonOutline{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}}};
}
inline std::vector<Outline> sampleOutlines() {
  return {RectangleOutline{1.3, 0.7}, DiscOutline{0.4}, arrowOutline(), clampOutline()};
}
/// A place inside each of them.
inline std::vector<Vec2d> placesInside() { return {{0.2, 0.1}, {-0.1, 0.1}, {0.5, 0.2}, {0.5, 1.5}}; }
inline std::vector<PointPattern> samplePatterns(std::size_t outline) {
  ImpactPoints blow;
  blow.impact = placesInside()[outline];
  return {UniformPoints{}, BlueNoisePoints{}, blow};
}

inline double areaOf(const FlatMesh& mesh, const Triangle& t) {
  const Vec2d ab = mesh.points[t[1]] - mesh.points[t[0]], ac = mesh.points[t[2]] - mesh.points[t[0]];
  return (ab.x * ac.y - ab.y * ac.x) / 2;
}
inline double totalAreaOf(const FlatMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += areaOf(mesh, t);
  return sum;
}
inline std::size_t pointsUsed(const FlatMesh& mesh) {
  std::set<std::uint32_t> used;
  for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
  return used.size();
}
inline double distanceOf(const Vec2d& a, const Vec2d& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The outline that points of a pattern were placed in, with a disc's corners.
inline std::vector<Vec2d> cornersFor(const Outline& outline, int count) {
  const double wide = polygonArea(outlineCorners(outline, 1e9));
  return outlineCorners(outline, std::sqrt(wide / count));
}

/// Triangles by their corners' places: what a triangulation is, whatever its points and triangles are numbered.
inline std::set<std::set<std::pair<double, double>>> shapesOf(const FlatMesh& mesh) {
  std::set<std::set<std::pair<double, double>>> all;
  for (const Triangle& t : mesh.triangles) {
    std::set<std::pair<double, double>> corners;
    for (const std::uint32_t v : t) corners.insert({mesh.points[v].x, mesh.points[v].y});
    all.insert(corners);
  }
  return all;
}

}  // namespace brisance
