// Conjugate gradients preconditioned by one geometric multigrid cycle, matrix-free: a level holds what each face lets
// through, no rows of a matrix (Trottenberg, Oosterlee & Schueller 2001; as a preconditioner Tatebe 1993). Its work
// does not grow with the surface of the solids.
#pragma once

#include "base/report.h"
#include "fluid/body_push.h"
#include "fluid/cell_field.h"
#include "fluid/fluid_state.h"

namespace brisance {

/// Linear interpolation from coarse to fine samples along one axis, cell centred: fine sample i takes `near` of coarse
/// sample i / ratio and `far` of coarse sample other[i].
struct AxisInterpolation {
  int ratio = 1;  ///< fine cells to a coarse one: 2, or 1 where the axis is too short to halve
  std::vector<int> other;
  std::vector<float> near, far;
};

/// sum over faces of coupling (x_cell - x_behind) = b. Couplings lie at the lower face of their cell.
/// Couplings along the three axes.
using Couplings = Vec3f;

struct MultigridLevel {
  CellField coupling[3];
  CellField inverseDiagonal;           ///< 0 in solids
  Couplings open{};                    ///< of wholly open inner faces
  std::vector<std::uint8_t> plainRow;  ///< by j + ny k: all faces of the row but those of its end cells are open
  CellField x, b, residual;
  std::array<AxisInterpolation, 3> coarser;  ///< to the next level
};

class Multigrid {
 public:
  /// No face of the box may be periodic. `push` takes the bodies that gas pushes into the operator.
  Multigrid(const SolidStamp& solid, const Faces& faces, BodyPush push = {});

  const CellLayout& layout() const { return levels_.front().x.layout; }
  /// Replaces b (zero in solids, of no net sum in a sealed pocket) by x with a residual of `tolerance` |b|.
  PressureReport solve(CellField& field, double tolerance, int maxIterations);

 private:
  void cycle(std::size_t level);
  double applyOperator();

  std::vector<MultigridLevel> levels_;
  CellField direction_, product_;
  BodyPush push_;
};

namespace detail {
std::vector<MultigridLevel> makeLevels(const SolidStamp& solid, const Faces& faces);
/// Gauss-Seidel in four colours, and in the opposite order: even planes before odd ones, in each the cells of even i +
/// j
/// + k before the others.
void relaxForward(MultigridLevel& level);
void relaxBackward(MultigridLevel& level);
/// relaxForward from x = 0.
void relaxFromZero(MultigridLevel& level);
void computeResidual(MultigridLevel& level);
/// Planes that one thread should take at least.
std::int64_t grainOf(const CellLayout& layout);
/// coarse.b = transposed interpolation of fine.residual
void restrictResidual(const MultigridLevel& fine, MultigridLevel& coarse);
/// fine.x += interpolation of coarse.x
void addCorrection(const MultigridLevel& coarse, MultigridLevel& fine);
/// product = A direction; returns direction . product
double applyLevel(const MultigridLevel& level, const CellField& direction, CellField& product);
}  // namespace detail

}  // namespace brisance
