// Pressure among solids by the empty box's direct solution. Conjugate gradients preconditioned with it need to know
// their vectors only where solids change the operator: outside, the operator undoes the preconditioner exactly, so
// residuals live on the gas cells beside solids alone (a capacitance method: Proskurowski & Widlund 1976). Only the
// preconditioner itself touches the whole box.
#pragma once

#include <optional>

#include "base/report.h"
#include "fluid/body_push.h"
#include "fluid/box_poisson.h"
#include "fluid/fluid_state.h"

namespace brisance {

/// The gas cells with a face that a solid closes, wholly or in part, and what each such face lacks.
struct SolidFaces {
  std::vector<std::int64_t> cell;        ///< place in the field, ascending
  std::vector<std::int32_t> firstLink;   ///< one more than cells: links of cell n are firstLink[n] .. firstLink[n + 1]
  std::vector<std::int64_t> other;       ///< by link: place of the cell behind the face
  std::vector<float> missing;            ///< by link: share of the empty box's face that is closed
  std::vector<std::int32_t> planeBegin;  ///< by plane, and one more: its first cell
  SparseRegion region;                   ///< where cells and the cells behind their faces lie
  BodyPush push;                         ///< of the bodies that give way; contacts numbered by `cell`

  bool empty() const { return cell.empty(); }
};
SolidFaces findSurface(const SolidStamp& solid, const BoxPoisson& box);
/// Takes the bodies that the gas pushes into the operator.
void addPush(BodyPush push, SolidFaces& surface);

/// Vectors over the cells of a surface.
struct SurfaceVectors {
  std::vector<double> residual, source, direction, product, correction, preconditioned, image;
  void resize(std::size_t count);
};

/// Solves the operator with solids for x. `field` holds b on entry (zero in solids, of no net sum in a sealed pocket)
/// and x on return; `work` is of the same layout. Ends when the residual is `tolerance` of |b|.
PressureReport solveFastPoisson(const BoxPoisson& box, const SolidFaces& surface, double tolerance, int maxIterations,
                                CellField& field, CellField& work, SurfaceVectors& vectors);

}  // namespace brisance
