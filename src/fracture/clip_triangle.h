// One triangle cut into the convex polygons that lie in the cells of a diagram, with exact answers throughout.
#pragma once

#include "fracture/cell_diagram.h"

namespace brisance {

/// A corner of a clipped triangle is where two of its lines meet: sides of the triangle (0, 1, 2: from corner to next
/// corner) and planes between the polygon's cell and others.
struct ClipSide {
  std::uint32_t cell = noCell;  ///< beyond this side; noCell: a side of the triangle
  std::uint32_t edge = 0;       ///< which side of the triangle
  Vec3l row;  ///< of a plane: how much nearer each corner of the triangle is to the polygon's cell than to `cell`
};

/// A point of the triangle by its shares of the three corners, not normalised, none below zero.
struct ClipPoint {
  Vec3<Int128> share;
};

/// Side k runs from point k to point k + 1.
struct ClippedTriangle {
  std::uint32_t cell = noCell;
  std::vector<ClipSide> sides;
  std::vector<ClipPoint> points;
};

/// The polygons of one triangle at a time. Throws Coincidence.
class TriangleClipper {
 public:
  explicit TriangleClipper(const CellDiagram& diagram) : diagram_(diagram) {}
  /// All cells that a triangle meets; `start` is the cell of its first corner.
  const std::vector<ClippedTriangle>& clip(const std::array<Vec3l, 3>& corners, std::uint32_t start);

 private:
  void clipToCell(ClippedTriangle& polygon, const std::array<Vec3l, 3>& corners);
  void cutOff(ClippedTriangle& polygon, const ClipSide& plane);

  const CellDiagram& diagram_;
  std::vector<ClippedTriangle> polygons_;
  std::size_t count_ = 0;
  std::vector<bool> inside_;
  std::vector<ClipSide> sides_;
  std::vector<ClipPoint> points_;
};

/// Shares of the corners where two planes meet the triangle; all of one sign.
Vec3<Int128> meeting(const Vec3l& rowA, const Vec3l& rowB);
/// share . row > 0; exact. Throws Coincidence where it is zero.
bool isNearer(const Vec3<Int128>& share, const Vec3l& row);

}  // namespace brisance
