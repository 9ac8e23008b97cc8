#include "mesh/triangle_net.h"

#include "base/check.h"

namespace brisance {
namespace {

/// The corners or neighbours of a triangle as seen from one of its edges.
Triangle rotated(const Triangle& t, int edge) { return {t[edge], t[(edge + 1) % 3], t[(edge + 2) % 3]}; }

}  // namespace

int TriangleNet::edgeTo(std::uint32_t triangle, std::uint32_t neighbour) const {
  const Triangle& all = neighbours_[triangle];
  const auto found = std::find(all.begin(), all.end(), neighbour);
  CHECK(found != all.end(), "triangles {} and {} do not touch", triangle, neighbour);
  return static_cast<int>(found - all.begin());
}

void TriangleNet::set(std::uint32_t triangle, const Triangle& corners, const Triangle& neighbours) {
  triangles_[triangle] = corners;
  neighbours_[triangle] = neighbours;
}

std::uint32_t TriangleNet::append(const Triangle& corners, const Triangle& neighbours) {
  triangles_.push_back(corners);
  neighbours_.push_back(neighbours);
  return static_cast<std::uint32_t>(triangles_.size() - 1);
}

void TriangleNet::relink(std::uint32_t triangle, std::uint32_t from, std::uint32_t to) {
  if (triangle != noTriangle) neighbours_[triangle][edgeTo(triangle, from)] = to;
}

void TriangleNet::splitInside(std::uint32_t triangle, std::uint32_t point) {
  const auto [a, b, c] = triangles_[triangle];
  const auto [acrossAb, acrossBc, acrossCa] = neighbours_[triangle];
  const auto second = static_cast<std::uint32_t>(triangles_.size()), third = second + 1;
  set(triangle, {a, b, point}, {acrossAb, second, third});
  append({b, c, point}, {acrossBc, third, triangle});
  append({c, a, point}, {acrossCa, triangle, second});
  relink(acrossBc, triangle, second);
  relink(acrossCa, triangle, third);
}

std::uint32_t TriangleNet::halve(std::uint32_t triangle, int edge, std::uint32_t point) {
  const auto [a, b, c] = rotated(triangles_[triangle], edge);
  const auto [across, acrossBc, acrossCa] = rotated(neighbours_[triangle], edge);
  const std::uint32_t half = append({point, b, c}, {across, acrossBc, triangle});
  set(triangle, {a, point, c}, {across, half, acrossCa});
  relink(acrossBc, triangle, half);
  return half;
}

void TriangleNet::splitEdge(std::uint32_t triangle, int edge, std::uint32_t point) {
  const std::uint32_t other = neighbours_[triangle][edge];
  const int otherEdge = other == noTriangle ? 0 : edgeTo(other, triangle);
  const std::uint32_t half = halve(triangle, edge, point);
  if (other == noTriangle) return;
  // The two sides run against each other: the start of one lies beside the end of the other.
  const std::uint32_t otherHalf = halve(other, otherEdge, point);
  neighbours_[triangle][0] = otherHalf;
  neighbours_[otherHalf][0] = triangle;
  neighbours_[half][0] = other;
  neighbours_[other][0] = half;
}

void TriangleNet::flip(std::uint32_t triangle, int edge) {
  const std::uint32_t other = neighbours_[triangle][edge];
  const int otherEdge = edgeTo(other, triangle);
  const auto [a, b, c] = rotated(triangles_[triangle], edge);
  const auto [unused1, acrossBc, acrossCa] = rotated(neighbours_[triangle], edge);
  const std::uint32_t d = rotated(triangles_[other], otherEdge)[2];
  const auto [unused2, acrossAd, acrossDb] = rotated(neighbours_[other], otherEdge);
  set(triangle, {a, d, c}, {acrossAd, other, acrossCa});
  set(other, {d, b, c}, {acrossDb, acrossBc, triangle});
  relink(acrossAd, other, triangle);
  relink(acrossBc, triangle, other);
}

}  // namespace brisance
