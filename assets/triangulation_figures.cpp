// 200 points three ways, and panes in pieces.
#include "assets/figures.h"
#include "fracture/breadth_first.h"
#include "mesh/voronoi_diagram.h"

namespace brisance::assets {
namespace {

constexpr double pictureWidth = 520;  // [px]
constexpr std::uint64_t seed = 3;
const Stroke outlineStroke{"#1d232b", 1.6};
const std::string pointColour = "#b3261e";
constexpr double pointRadius = 1.6;

/// The 200 points of Figures 3.4 to 3.6.
std::vector<Vec2d> samplePoints() {
  std::vector<Vec2d> points = panePoints(1, 1, 200, 0, seed);
  return {points.begin() + 4, points.end()};  // without the corners of the square
}

FlatDrawing triangulationFigure(const Triangulation& method) {
  const std::vector<Vec2d> points = samplePoints();
  const FlatMesh mesh = triangulate(points, method, seed);
  FlatDrawing drawing(boundsOf(points), pictureWidth);
  drawing.segments(edgesOf(mesh), {});
  drawing.dots(points, pointRadius, pointColour);
  return drawing;
}

void drawBroken(FlatDrawing& drawing, const FlatMesh& mesh, int pieces, std::span<const std::string> colours,
                double crackWidth) {
  const Partition cut = partitionBreadthFirst(triangleGraph(mesh.triangles, mesh.points.size()), pieces);
  drawPieces(drawing, mesh, cut.pieceOf, cut.count, colours);
  drawing.segments(cutsOf(mesh, cut.pieceOf), {"#22303c", crackWidth});
  drawing.segments(borderOf(mesh), outlineStroke);
}

const std::vector<std::string> glassColours{"#cfe3ee", "#b9d6e6", "#e3f0f6", "#a6c9dd", "#d8e9e6", "#c3d9ec"};
const std::vector<std::string> plainColours{"#f3b48f", "#9fc5e8", "#b6d7a8", "#ffe08a",
                                            "#d5a6bd", "#a2d5cf", "#d9c9a3"};

FlatMesh paneMesh(const Outline& outline, const PointPattern& pattern, int points) {
  return triangulatePane(placePoints(outline, pattern, points, seed), Delaunay{}, seed);
}

}  // namespace

FlatDrawing trisectionFigure() { return triangulationFigure(Trisection{}); }
FlatDrawing delaunayFigure() { return triangulationFigure(Delaunay{}); }

FlatDrawing voronoiFigure() {
  const std::vector<Vec2d> points = samplePoints();
  const double half = 0.5;
  const std::vector<Vec2d> square{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  const VoronoiDiagram diagram = voronoiDiagram(points, square);
  std::vector<Segment> edges;
  for (const VoronoiEdge& edge : diagram.edges) edges.push_back({edge.from, edge.to});
  FlatDrawing drawing(boundsOf(square), pictureWidth);
  drawing.segments(edges, {});
  drawing.polygon(square, "", outlineStroke);
  drawing.dots(points, pointRadius, pointColour);
  return drawing;
}

FlatDrawing struckPaneFigure() {
  const RectangleOutline pane{1.2, 0.9};
  ImpactPoints blow;
  blow.impact = {-0.14, 0.08};
  blow.spokes = 28;
  blow.irregularity = 0.35;
  const FlatMesh mesh = paneMesh(pane, blow, 210);
  FlatDrawing drawing(boundsOf(mesh.points), 640);
  drawBroken(drawing, mesh, 240, glassColours, 0.9);
  return drawing;
}

FlatDrawing outlinesFigure() {
  const PolygonOutline arrow{{{0.7, -0.5}, {1.7, -0.5}, {1.7, 0.1}, {1.3, -0.15}, {1.15, 0.5}, {0.7, 0.5}, {0.95, 0}}};
  const FlatMesh disc = paneMesh(DiscOutline{0.5}, BlueNoisePoints{}, 110),
                 concave = paneMesh(arrow, BlueNoisePoints{}, 110);
  Box3 box = boundsOf(disc.points);
  for (const Vec2d& p : concave.points) box.include({p.x, p.y, 0});
  FlatDrawing drawing(box, 720);
  for (const FlatMesh* mesh : {&disc, &concave}) {
    drawBroken(drawing, *mesh, 12, plainColours, 2);
    drawing.segments(edgesOf(*mesh), {"#22303c", 0.35});
  }
  return drawing;
}

}  // namespace brisance::assets
