#include "mesh/flat_drawing.h"

#include <fmt/format.h>

#include <set>

#include "base/durable_file.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

std::string strokeOf(const Stroke& stroke) {
  return fmt::format(R"(stroke="{}" stroke-width="{:.3g}"{})", stroke.colour, stroke.width,
                     stroke.dotted ? R"( stroke-dasharray="1 4")" : "");
}

/// Calls visit(triangle, edge, neighbour) for each edge from one of its sides.
template <class Visit>
void forEachEdge(const FlatMesh& mesh, const Visit& visit) {
  const std::vector<Triangle> neighbours = edgeNeighbours(mesh.triangles, mesh.points.size());
  for (std::uint32_t t = 0; t < neighbours.size(); ++t)
    for (std::size_t edge = 0; edge < 3; ++edge)
      if (neighbours[t][edge] == noTriangle || neighbours[t][edge] > t) visit(t, edge, neighbours[t][edge]);
}

Segment segmentOf(const FlatMesh& mesh, std::uint32_t triangle, std::size_t edge) {
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.points[t[edge]], mesh.points[t[(edge + 1) % 3]]};
}

/// Greedily, in order of pieces: the least used colour that no neighbour has.
std::vector<std::size_t> colourPieces(const FlatMesh& mesh, std::span<const int> pieceOf, int pieces,
                                      std::size_t colours) {
  std::vector<std::set<int>> touching(static_cast<std::size_t>(pieces));
  forEachEdge(mesh, [&](std::uint32_t t, std::size_t, std::uint32_t other) {
    if (other == noTriangle || pieceOf[t] == pieceOf[other]) return;
    touching[static_cast<std::size_t>(pieceOf[t])].insert(pieceOf[other]);
    touching[static_cast<std::size_t>(pieceOf[other])].insert(pieceOf[t]);
  });
  std::vector<std::size_t> colourOf(touching.size(), 0), uses(colours, 0);
  for (std::size_t piece = 0; piece < touching.size(); ++piece) {
    std::vector<std::size_t> cost = uses;
    for (const int other : touching[piece])
      if (static_cast<std::size_t>(other) < piece) cost[colourOf[static_cast<std::size_t>(other)]] += touching.size();
    colourOf[piece] = static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    ++uses[colourOf[piece]];
  }
  return colourOf;
}

}  // namespace

FlatDrawing::FlatDrawing(const Box3& box, double width, double margin)
    : box_(box), scale_((width - 2 * margin) / box.size().x), margin_(margin) {}

std::string FlatDrawing::point(const Vec2d& p) const {
  return fmt::format("{:.1f} {:.1f}", margin_ + (p.x - box_.lower.x) * scale_, margin_ + (box_.upper.y - p.y) * scale_);
}

void FlatDrawing::segments(std::span<const Segment> lines, const Stroke& stroke) {
  body_ += R"(<path d=")";
  for (const Segment& line : lines) body_ += fmt::format("M{}L{}", point(line.from), point(line.to));
  body_ += fmt::format("\" fill=\"none\" {}/>\n", strokeOf(stroke));
}

void FlatDrawing::polyline(std::span<const Vec2d> points, const Stroke& stroke) {
  body_ += R"(<path d=")";
  for (std::size_t i = 0; i < points.size(); ++i) body_ += fmt::format("{}{}", i == 0 ? "M" : "L", point(points[i]));
  body_ += fmt::format("\" fill=\"none\" {}/>\n", strokeOf(stroke));
}

void FlatDrawing::polygon(std::span<const Vec2d> corners, const std::string& fill, const Stroke& stroke) {
  const std::vector<Vec2d> one(corners.begin(), corners.end());
  polygons({&one, 1}, fill, stroke);
}

void FlatDrawing::polygons(std::span<const std::vector<Vec2d>> all, const std::string& fill, const Stroke& stroke) {
  body_ += R"(<path d=")";
  for (const std::vector<Vec2d>& corners : all) {
    for (std::size_t i = 0; i < corners.size(); ++i)
      body_ += fmt::format("{}{}", i == 0 ? "M" : "L", point(corners[i]));
    body_ += "Z";
  }
  body_ += fmt::format("\" fill=\"{}\" {}/>\n", fill.empty() ? "none" : fill, strokeOf(stroke));
}

void FlatDrawing::dots(std::span<const Vec2d> points, double radius, const std::string& colour) {
  // A line of no length with round ends is a dot.
  body_ += R"(<path d=")";
  for (const Vec2d& p : points) body_ += fmt::format("M{}h0", point(p));
  body_ += fmt::format("\" stroke=\"{}\" stroke-width=\"{:.3g}\"/>\n", colour, 2 * radius);
}

void FlatDrawing::text(const Vec2d& place, const std::string& words, double size, const std::string& colour) {
  const double lowered = 0.35 * size;  // the middle of a digit lies so far above its base line
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.3g}\" fill=\"{}\">{}</text>\n",
                       margin_ + (place.x - box_.lower.x) * scale_,
                       margin_ + (box_.upper.y - place.y) * scale_ + lowered, size, colour, words);
}

std::string FlatDrawing::svg() const {
  const double width = box_.size().x * scale_ + 2 * margin_, height = box_.size().y * scale_ + 2 * margin_;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "stroke-linejoin=\"round\" stroke-linecap=\"round\" font-family=\"sans-serif\" text-anchor=\"middle\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{2}</svg>\n",
      width, height, body_);
}

void writeDrawing(const std::filesystem::path& file, const FlatDrawing& drawing) { writeDurably(file, drawing.svg()); }

Box3 boundsOf(std::span<const Vec2d> points) {
  Box3 box;
  for (const Vec2d& p : points) box.include({p.x, p.y, 0});
  return box;
}

std::vector<Segment> edgesOf(const FlatMesh& mesh) {
  std::vector<Segment> segments;
  forEachEdge(mesh,
              [&](std::uint32_t t, std::size_t edge, std::uint32_t) { segments.push_back(segmentOf(mesh, t, edge)); });
  return segments;
}

std::vector<Segment> cutsOf(const FlatMesh& mesh, std::span<const int> pieceOf) {
  std::vector<Segment> segments;
  forEachEdge(mesh, [&](std::uint32_t t, std::size_t edge, std::uint32_t other) {
    if (other != noTriangle && pieceOf[t] != pieceOf[other]) segments.push_back(segmentOf(mesh, t, edge));
  });
  return segments;
}

std::vector<Segment> borderOf(const FlatMesh& mesh) {
  std::vector<Segment> segments;
  forEachEdge(mesh, [&](std::uint32_t t, std::size_t edge, std::uint32_t other) {
    if (other == noTriangle) segments.push_back(segmentOf(mesh, t, edge));
  });
  return segments;
}

Vec2d centroidOf(const FlatMesh& mesh, const Triangle& triangle) {
  return (mesh.points[triangle[0]] + mesh.points[triangle[1]] + mesh.points[triangle[2]]) * (1.0 / 3);
}

void drawPieces(FlatDrawing& drawing, const FlatMesh& mesh, std::span<const int> pieceOf, int pieces,
                std::span<const std::string> colours) {
  const std::vector<std::size_t> colourOf = colourPieces(mesh, pieceOf, pieces, colours.size());
  std::vector<std::vector<std::vector<Vec2d>>> trianglesOf(colours.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    trianglesOf[colourOf[static_cast<std::size_t>(pieceOf[t])]].push_back(
        {mesh.points[a], mesh.points[b], mesh.points[c]});
  }
  // The stroke closes the hairline between two triangles.
  for (std::size_t i = 0; i < colours.size(); ++i) drawing.polygons(trianglesOf[i], colours[i], {colours[i], 0.6});
}

}  // namespace brisance
