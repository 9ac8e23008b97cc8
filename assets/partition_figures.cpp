// How a breadth-first search cuts a mesh, and why a vibrating string is cut at its nodes.
#include "assets/figures.h"
#include "base/check.h"
#include "mesh/mesh_topology.h"

namespace brisance::assets {
namespace {

constexpr double pictureWidth = 640;  // [px]
constexpr int unreached = -1;

/// Some triangles of a mesh with their distances from the first.
struct Search {
  FlatMesh mesh;
  std::vector<int> level;
  int deepest = 0;
};

/// Triangles that share a corner, as Algorithm 5 has it.
std::vector<std::vector<std::uint32_t>> cornerNeighbours(const FlatMesh& mesh) {
  std::vector<std::vector<std::uint32_t>> at(mesh.points.size()), result(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) at[v].push_back(t);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) result[t].insert(result[t].end(), at[v].begin(), at[v].end());
  return result;
}

std::vector<int> levelsFrom(const FlatMesh& mesh, std::uint32_t start) {
  const auto neighbours = cornerNeighbours(mesh);
  std::vector<int> level(mesh.triangles.size(), unreached);
  std::vector<std::uint32_t> queue{start};
  level[start] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const std::uint32_t child : neighbours[queue[i]]) {
      if (level[child] != unreached) continue;
      level[child] = level[queue[i]] + 1;
      queue.push_back(child);
    }
  return level;
}

Search searchFrom(const FlatMesh& mesh, std::uint32_t start) {
  Search search{mesh, levelsFrom(mesh, start), 0};
  search.deepest = *std::max_element(search.level.begin(), search.level.end());
  return search;
}

FlatMesh fartherPart(const Search& search) {
  FlatMesh part{search.mesh.points, {}};
  for (std::size_t t = 0; t < search.level.size(); ++t)
    if (search.level[t] > search.deepest / 2) part.triangles.push_back(search.mesh.triangles[t]);
  return part;
}

/// How many triangles the search does not reach from the first.
std::size_t lostTriangles(const FlatMesh& mesh) {
  const std::vector<int> level = levelsFrom(mesh, 0);
  return static_cast<std::size_t>(std::count(level.begin(), level.end(), unreached));
}

std::uint32_t triangleNearest(const FlatMesh& mesh, const Vec2d& place) {
  const auto distance = [&](const Triangle& t) {
    const Vec2d off = centroidOf(mesh, t) - place;
    return off.x * off.x + off.y * off.y;
  };
  return static_cast<std::uint32_t>(
      std::min_element(mesh.triangles.begin(), mesh.triangles.end(),
                       [&](const Triangle& a, const Triangle& b) { return distance(a) < distance(b); }) -
      mesh.triangles.begin());
}

Search firstSearch() {
  const PolygonOutline outline{{{0, 0.15}, {0.5, 0}, {1.3, 0.05}, {1.6, 0.4}, {1.5, 0.85}, {0.9, 1}, {0.25, 0.9}}};
  const FlatMesh mesh = triangulatePane(placePoints(outline, BlueNoisePoints{}, 38, 3), Delaunay{}, 3);
  return searchFrom(mesh, triangleNearest(mesh, {0, 0.5}));
}

/// From the start whose farther part loses most triangles, if it too has as many levels as the first search.
Search secondSearch() {
  const FlatMesh part = fartherPart(firstSearch());
  Search best;
  std::size_t most = 0;
  for (std::uint32_t start = 0; start < part.triangles.size(); ++start) {
    const Search search = searchFrom(part, start);
    const FlatMesh farther = fartherPart(search);
    const std::size_t lost = farther.triangles.empty() ? 0 : lostTriangles(farther);
    const std::size_t smaller = std::min(lost, farther.triangles.size() - lost);
    if (smaller <= most) continue;
    most = smaller;
    best = search;
  }
  CHECK(most > 0, "no start leaves islands");
  return best;
}

FlatDrawing levelsFigure(const Search& search, const Box3& box) {
  const std::string nearColour = "#fdf0dc", farColour = "#dbe8f4";
  FlatDrawing drawing(box, pictureWidth);
  std::vector<int> side;
  for (std::size_t t = 0; t < search.level.size(); ++t) {
    side.push_back(search.level[t] > search.deepest / 2 ? 1 : 0);
    std::vector<Vec2d> corners;
    for (const std::uint32_t v : search.mesh.triangles[t]) corners.push_back(search.mesh.points[v]);
    drawing.polygon(corners, side.back() == 0 ? nearColour : farColour, {"#5c6773", 0.8});
  }
  drawing.segments(borderOf(search.mesh), {"#1d232b", 1.6});
  drawing.segments(cutsOf(search.mesh, side), {"#1d232b", 4});
  for (std::size_t t = 0; t < search.level.size(); ++t)
    drawing.text(centroidOf(search.mesh, search.mesh.triangles[t]), std::to_string(search.level[t]), 15);
  return drawing;
}

/// Displacement of a string of length 1 in its mode `n`.
std::vector<Vec2d> stringShape(int mode, double amplitude, double rest) {
  constexpr int steps = 90;
  std::vector<Vec2d> shape;
  for (int i = 0; i <= steps; ++i) {
    const double x = static_cast<double>(i) / steps;
    shape.push_back({x, rest + amplitude * portableSinCos(pi * mode * x).sin});
  }
  return shape;
}

}  // namespace

FlatDrawing firstLevelsFigure() {
  const Search search = firstSearch();
  return levelsFigure(search, boundsOf(search.mesh.points));
}

FlatDrawing secondLevelsFigure() {
  const Search search = secondSearch();
  return levelsFigure(search, boundsOf(search.mesh.points));
}

FlatDrawing vibratingStringFigure() {
  constexpr double amplitude = 0.1, rowHeight = 0.3;
  const char* names[] = {"lowest frequency", "second frequency", "third frequency"};
  Box3 box{{0, -0.66, 0}, {1, 0.16, 0}};
  box.lower.y -= 0.12;
  FlatDrawing drawing(box, pictureWidth, 16);
  for (int mode = 1; mode <= 3; ++mode) {
    const double rest = -rowHeight * (mode - 1);
    const std::vector<Vec2d> ends{{0, rest}, {1, rest}};
    drawing.polyline(ends, {"#5c6773", 1.4, true});
    drawing.polyline(stringShape(mode, amplitude, rest), {"#1f5f99", 2.4});
    drawing.dots(ends, 4, "#1d232b");
    for (int part = 0; part < mode; ++part)
      drawing.text({(part + 0.5) / mode, rest + (part % 2 == 0 ? 0.045 : -0.045)}, part % 2 == 0 ? "+" : "\u2212", 22);
    drawing.text({0.5, rest - 0.14}, names[mode - 1], 14, "#5c6773");
  }
  return drawing;
}

}  // namespace brisance::assets
