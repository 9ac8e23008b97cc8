// Flat meshes, partitions and Voronoi diagrams as drawings (SVG).
#pragma once

#include <filesystem>
#include <span>

#include "mesh/triangulation.h"

namespace brisance {

struct Stroke {
  std::string colour = "#2b3440";
  double width = 0.8;  ///< [px]
  bool dotted = false;
};
struct Segment {
  Vec2d from, to;
};

/// Lengths in metres, y upwards, drawn over one another in the order they come.
class FlatDrawing {
 public:
  /// Shows a box, `width` pixels wide, with a margin around it [px].
  FlatDrawing(const Box3& box, double width, double margin = 8);

  void segments(std::span<const Segment> lines, const Stroke& stroke);
  void polyline(std::span<const Vec2d> points, const Stroke& stroke);
  /// A closed outline, filled if `fill` names a colour.
  void polygon(std::span<const Vec2d> corners, const std::string& fill, const Stroke& stroke);
  void polygons(std::span<const std::vector<Vec2d>> all, const std::string& fill, const Stroke& stroke);
  void dots(std::span<const Vec2d> points, double radius, const std::string& colour);  ///< radius in px
  /// Centred on a place.
  void text(const Vec2d& place, const std::string& words, double size, const std::string& colour = "#1d232b");

  std::string svg() const;

 private:
  std::string point(const Vec2d& p) const;

  Box3 box_;
  double scale_, margin_;
  std::string body_;
};

/// Saves a drawing under a temporary name first. Throws Error where that fails.
void writeDrawing(const std::filesystem::path& file, const FlatDrawing& drawing);

Box3 boundsOf(std::span<const Vec2d> points);
/// Every edge once.
std::vector<Segment> edgesOf(const FlatMesh& mesh);
/// Edges between triangles of different pieces.
std::vector<Segment> cutsOf(const FlatMesh& mesh, std::span<const int> pieceOf);
/// Edges of one triangle.
std::vector<Segment> borderOf(const FlatMesh& mesh);
Vec2d centroidOf(const FlatMesh& mesh, const Triangle& triangle);

/// Fills each piece with one of a few colours, neighbours with different ones.
void drawPieces(FlatDrawing& drawing, const FlatMesh& mesh, std::span<const int> pieceOf, int pieces,
                std::span<const std::string> colours);

}  // namespace brisance
