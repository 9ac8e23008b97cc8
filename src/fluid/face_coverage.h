// How much of each face of a plane of faces lies in a solid, exactly: the polygon in which the plane cuts the mesh is
// added up edge by edge, as exact-coverage rasterisers of fonts do.
#pragma once

#include <span>
#include <vector>

#include "base/math.h"

namespace brisance {

/// A window of unit squares [p0, p1) x [q0, q1).
struct SquareWindow {
  int p0, p1, q0, q1;
  int columns() const { return p1 - p0; }
  int rows() const { return q1 - q0; }
  bool empty() const { return p1 <= p0 || q1 <= q0; }
};

/// Adds up the directed edges of closed polygons.
class CoverageSum {
 public:
  explicit CoverageSum(const SquareWindow& window);
  void addEdge(Vec2d from, Vec2d to);
  /// Share of square (p, q) inside the polygons, from 0 to 1, whichever way round they run. Call `finish` before.
  void finish();
  double share(int p, int q) const { return area_[at(p, q)]; }

 private:
  void addInRow(int q, Vec2d from, Vec2d to);
  void addInSquare(int p, int q, double rise, double meanP);
  std::size_t at(int p, int q) const {
    return static_cast<std::size_t>(q - window_.q0) * (window_.columns() + 1) + (p - window_.p0);
  }
  SquareWindow window_;
  std::vector<double> area_, carry_;  // signed: to the right of edges within the square; and of all squares further on
};

}  // namespace brisance
