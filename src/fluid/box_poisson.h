// Poisson's equation in a box without solids, solved directly: h^2 (-div grad) x = b falls apart into equations along
// z, one for each pair of the modes of trigonometric_transform.h along x and y, and these are solved by elimination
// (Hockney 1965; Swarztrauber 1977). The eigenvalues are those of the seven-point operator itself.
#pragma once

#include <functional>

#include "fluid/cell_field.h"
#include "fluid/line_elimination.h"
#include "fluid/trigonometric_transform.h"

namespace brisance {

/// Where sources lie and where the solution is asked for, by plane (constant k) and by 16 rows of a plane.
struct SparseRegion {
  std::vector<std::uint8_t> planes;  ///< by k
  std::vector<std::uint8_t> tiles;   ///< by k * tilesPerPlane + j / 16
};

class BoxPoisson {
 public:
  /// Sizes as LineTransform takes them; pairs of faces that are both periodic or both not.
  BoxPoisson(const Vec3i& cells, const Faces& faces);

  const CellLayout& layout() const { return layout_; }
  const Faces& faces() const { return faces_; }
  int tilesPerPlane() const { return (layout_.cells.y + LineTransform::lanes - 1) / LineTransform::lanes; }

  /// Replaces b by x in three sweeps over the field. With no open face the mean of b is ignored and that of x is 0.
  void solve(CellField& field) const;
  /// The same for a b that `fill` writes plane by plane (at the given pointer to its cell (0, 0)), so that it does not
  /// come from memory.
  using Fill = std::function<void(int k, float* plane)>;
  void solve(CellField& field, const Fill& fill) const;
  /// The same for a b that is zero and an x that is wanted only in a region. `fill` writes b into a plane k of
  /// zeros; what lies outside the region is neither read nor left meaningful.
  void solve(CellField& field, const SparseRegion& region, const Fill& fill) const;

 private:
  void toModes(float* plane, const std::uint8_t* tiles, float* lines, float* work) const;
  void fromModes(float* plane, const std::uint8_t* tiles, float* lines, float* work) const;
  void solveAlongZ(CellField& field, const std::uint8_t* planes) const;

  CellLayout layout_;
  Faces faces_;
  LineTransform x_, y_;
  LineElimination z_;
  AlignedFloats eigenvalueX_;  // up to the rounded row
  std::vector<float> eigenvalueY_;
  bool singular_;
};

}  // namespace brisance
