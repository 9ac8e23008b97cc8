#include "assets/elastic_mesh.h"

#include "base/check.h"

namespace brisance::samples {
namespace {

constexpr std::uint32_t noneThere = 0xFFFFFFFFu;

/// Position of the corner in the triangle, 3 where it has none such.
int cornerIn(const Triangle& t, std::uint32_t vertex) {
  return static_cast<int>(std::find(t.begin(), t.end(), vertex) - t.begin());
}

}  // namespace

ElasticMesh::ElasticMesh(const TriangleMesh& mesh)
    : places_(mesh.vertices), triangles_(mesh.triangles), gone_(mesh.triangles.size()), around_(mesh.vertices.size()) {
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) attach(t);
  alive_ = triangles_.size();
}

std::vector<ElasticMesh::Edge> ElasticMesh::edges() const {
  std::vector<Edge> result;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (gone_[t]) continue;
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = triangles_[t][corner], b = triangles_[t][(corner + 1) % 3];
      if (a < b) result.push_back({a, b});
    }
  }
  return result;
}

bool ElasticMesh::has(const Edge& edge) const {
  return std::any_of(around_[edge.a].begin(), around_[edge.a].end(),
                     [&](std::uint32_t t) { return cornerIn(triangles_[t], edge.b) < 3; });
}

std::vector<std::uint32_t> ElasticMesh::neighbours(std::uint32_t vertex) const {
  std::vector<std::uint32_t> result;
  for (const std::uint32_t t : around_[vertex])
    result.push_back(triangles_[t][(cornerIn(triangles_[t], vertex) + 1) % 3]);
  std::sort(result.begin(), result.end());
  return result;
}

Vec3d ElasticMesh::areaVector(const Triangle& t) const {
  return cross(places_[t[1]] - places_[t[0]], places_[t[2]] - places_[t[0]]) / 2.0;
}

Vec3d ElasticMesh::normalAt(std::uint32_t vertex) const {
  Vec3d sum;
  for (const std::uint32_t t : around_[vertex]) sum += areaVector(triangles_[t]);
  return normalized(sum);
}

ElasticMesh::Wings ElasticMesh::wingsOf(const Edge& edge) const {
  Wings wings{noneThere, noneThere, noneThere, noneThere};
  for (const std::uint32_t t : around_[edge.a]) {
    const int corner = cornerIn(triangles_[t], edge.a);
    const std::uint32_t next = triangles_[t][(corner + 1) % 3], last = triangles_[t][(corner + 2) % 3];
    if (next == edge.b) {
      wings.left = t;
      wings.leftCorner = last;
    } else if (last == edge.b) {
      wings.right = t;
      wings.rightCorner = next;
    }
  }
  CHECK(wings.left != noneThere && wings.right != noneThere, "edge {} {} is open", edge.a, edge.b);
  return wings;
}

void ElasticMesh::attach(std::uint32_t triangle) {
  for (const std::uint32_t v : triangles_[triangle]) around_[v].push_back(triangle);
}

void ElasticMesh::detach(std::uint32_t triangle) {
  for (const std::uint32_t v : triangles_[triangle]) std::erase(around_[v], triangle);
}

void ElasticMesh::replaceCorner(std::uint32_t triangle, std::uint32_t from, std::uint32_t to) {
  detach(triangle);
  triangles_[triangle][cornerIn(triangles_[triangle], from)] = to;
  attach(triangle);
}

void ElasticMesh::split(const Edge& edge, const Vec3d& place) {
  const Wings wings = wingsOf(edge);
  const auto middle = static_cast<std::uint32_t>(places_.size());
  places_.push_back(place);
  around_.emplace_back();
  for (const std::uint32_t t : {wings.left, wings.right}) {
    Triangle half = triangles_[t];
    half[cornerIn(half, edge.a)] = middle;
    replaceCorner(t, edge.b, middle);
    triangles_.push_back(half);
    gone_.push_back(false);
    attach(static_cast<std::uint32_t>(triangles_.size() - 1));
  }
  alive_ += 2;
}

bool ElasticMesh::turnsOver(std::uint32_t vertex, const Edge& collapsing, const Vec3d& place) const {
  constexpr double steepest = 0.5;  // cosine of 60 degrees
  for (const std::uint32_t t : around_[vertex]) {
    const Triangle& corners = triangles_[t];
    if (cornerIn(corners, collapsing.a) < 3 && cornerIn(corners, collapsing.b) < 3) continue;
    const int corner = cornerIn(corners, vertex);
    const Vec3d &b = places_[corners[(corner + 1) % 3]], &c = places_[corners[(corner + 2) % 3]];
    const Vec3d before = areaVector(corners), after = cross(b - place, c - place);
    if (dot(before, after) < steepest * length(before) * length(after)) return true;
  }
  return false;
}

bool ElasticMesh::collapse(const Edge& edge, const Vec3d& place) {
  const Wings wings = wingsOf(edge);
  const auto atA = neighbours(edge.a), atB = neighbours(edge.b);
  std::vector<std::uint32_t> common;
  std::set_intersection(atA.begin(), atA.end(), atB.begin(), atB.end(), std::back_inserter(common));
  // The link condition (Dey, Edelsbrunner, Guha & Nekhayev 1999), and no corner left with two triangles only.
  if (common.size() != 2 || valence(wings.leftCorner) <= 3 || valence(wings.rightCorner) <= 3) return false;
  if (turnsOver(edge.a, edge, place) || turnsOver(edge.b, edge, place)) return false;
  for (const std::uint32_t t : {wings.left, wings.right}) {
    detach(t);
    gone_[t] = true;
  }
  const std::vector<std::uint32_t> moved = around_[edge.b];
  for (const std::uint32_t t : moved) replaceCorner(t, edge.b, edge.a);
  places_[edge.a] = place;
  alive_ -= 2;
  return true;
}

bool ElasticMesh::flip(const Edge& edge) {
  const Wings wings = wingsOf(edge);
  const std::uint32_t left = wings.left, right = wings.right, c = wings.leftCorner, d = wings.rightCorner;
  constexpr int even = 6;
  const auto unevenness = [&](int change) {
    int sum = 0;
    for (const std::uint32_t v : {edge.a, edge.b}) sum += (valence(v) - change - even) * (valence(v) - change - even);
    for (const std::uint32_t v : {c, d}) sum += (valence(v) + change - even) * (valence(v) + change - even);
    return sum;
  };
  if (unevenness(1) >= unevenness(0) || valence(edge.a) <= 3 || valence(edge.b) <= 3 || has({c, d})) return false;
  const Triangle newLeft{edge.a, d, c}, newRight{d, edge.b, c};
  const Vec3d before = normalized(areaVector(triangles_[left]) + areaVector(triangles_[right]));
  constexpr double steepest = 0.7;  // cosine of 45 degrees
  for (const Triangle& t : {newLeft, newRight})
    if (dot(normalized(areaVector(t)), before) < steepest) return false;
  for (const std::uint32_t t : {left, right}) detach(t);
  triangles_[left] = newLeft;
  triangles_[right] = newRight;
  for (const std::uint32_t t : {left, right}) attach(t);
  return true;
}

TriangleMesh ElasticMesh::mesh() const {
  TriangleMesh result;
  std::vector<std::uint32_t> number(places_.size());
  for (std::size_t v = 0; v < places_.size(); ++v) {
    number[v] = static_cast<std::uint32_t>(result.vertices.size());
    if (!around_[v].empty()) result.vertices.push_back(places_[v]);
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    if (!gone_[t])
      result.triangles.push_back({number[triangles_[t][0]], number[triangles_[t][1]], number[triangles_[t][2]]});
  return result;
}

}  // namespace brisance::samples
