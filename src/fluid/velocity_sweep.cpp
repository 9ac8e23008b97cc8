#include "base/parallel.h"
#include "base/row_lines.h"
#include "base/vector_path.h"
#include "fluid/advection.h"
#include "fluid/donor_rows.h"
#include "fluid/donor_sweep.h"
#include "fluid/forces.h"

namespace brisance {

namespace {
/// Of a velocity component and of what carries it.
struct Stencil {
  Neighbours s;
  FaceSides sides;

  /// Along its own axis a component carries itself.
  void carryItself(int axis) {
    sides.lowerPair[axis][0] = s.lower[axis];
    sides.lowerPair[axis][1] = sides.upperPair[axis][0] = s.here;
    sides.upperPair[axis][1] = s.upper[axis];
  }
  void setSides(int axis, const float* lower0, const float* lower1, const float* upper0, const float* upper1) {
    sides.lowerPair[axis][0] = lower0;
    sides.lowerPair[axis][1] = lower1;
    sides.upperPair[axis][0] = upper0;
    sides.upperPair[axis][1] = upper1;
  }
};

/// The old velocity's rows, and what accelerates the new one.
class SpeedSweep {
 public:
  SpeedSweep(const FluidState& gas, const FluidSettings& settings, double dt, MacVelocity& out)
      : gas_(gas),
        settings_(settings),
        out_(out),
        rows_{componentRows(0), componentRows(1), componentRows(2)},
        c_(static_cast<float>(dt / settings.cellSize) / (2 * FaceSides::perSpeed)),
        weight_(upwindWeightOf(settings)),
        dt_(dt) {}
  static constexpr int rooms = 15;

  void plane(int k, Rooms& made) const {
    const Vec3i cells = gas_.temperature.size;
    EndedRows ended;
    for (int j = 0; j <= cells.y; ++j)
      runWide([&] {
        ended = endedRows(j, k, ended.vUpper, made);
        if (k < cells.z && j < cells.y) accelerateAlongX(j, k, ended, made);
        if (k < cells.z) accelerateAlongY(j, k, ended.v, made);
        if (j < cells.y) accelerateAlongZ(j, k, ended.w, made);
      });
  }

 private:
  GhostRows componentRows(int axis) const {
    return {gas_.velocity.component(axis), axis, static_cast<float>(settings_.wind[axis]), gas_.velocity,
            settings_.faces};
  }
  float force(int axis) const { return static_cast<float>(dt_ * settings_.force[axis]); }

  /// Copies with ghosts at their ends of the rows around cells (j, k), of those that there are.
  struct EndedRows {
    const float *v = nullptr, *vUpper = nullptr, *w = nullptr, *wUpper = nullptr;
  };
  /// `v`: that of row j, made for the row before as its `vUpper`.
  EndedRows endedRows(int j, int k, const float* v, Rooms& made) const {
    const Vec3i cells = gas_.temperature.size;
    const bool inRows = j < cells.y, inPlanes = k < cells.z;
    EndedRows rows;
    if (inPlanes) rows.v = j == 0 ? rows_[1].withEnds(0, k, made[11]) : v;
    if (inPlanes && inRows) rows.vUpper = rows_[1].withEnds(j + 1, k, made[11 + (j + 1) % 2]);
    if (inRows) rows.w = rows_[2].withEnds(j, k, made[13]);
    if (inPlanes && inRows) rows.wUpper = rows_[2].withEnds(j, k + 1, made[14]);
    return rows;
  }

  void accelerateAlongX(int j, int k, const EndedRows& ended, Rooms& made) const {
    Stencil x{neighboursOf(rows_[0], j, k, made, 0), {}};
    x.carryItself(0);
    x.setSides(1, ended.v - 1, ended.v, ended.vUpper - 1, ended.vUpper);
    x.setSides(2, ended.w - 1, ended.w, ended.wUpper - 1, ended.wUpper);
    const float gained = force(0);
    accelerate(0, x, j, k, [=](std::int64_t) { return gained; });
  }

  void accelerateAlongY(int j, int k, const float* v, Rooms& made) const {
    Stencil y{neighboursOfEnded(rows_[1], j, k, v, made, 0), {}};
    y.carryItself(1);
    const float *u = rows_[0].row(j - 1, k, made[5]), *uNext = rows_[0].row(j, k, made[6]);
    y.setSides(0, u, uNext, u + 1, uNext + 1);
    y.setSides(2, rows_[2].row(j - 1, k, made[7]), rows_[2].row(j, k, made[8]), rows_[2].row(j - 1, k + 1, made[9]),
               rows_[2].row(j, k + 1, made[10]));
    const float gained = force(1);
    if (settings_.buoyancy == 0) return accelerate(1, y, j, k, [=](std::int64_t) { return gained; });
    const Lift lift(gas_.temperature, settings_, dt_, j, k);
    accelerate(1, y, j, k, [=](std::int64_t i) { return gained + lift(i); });
  }

  void accelerateAlongZ(int j, int k, const float* w, Rooms& made) const {
    Stencil z{neighboursOfEnded(rows_[2], j, k, w, made, 0), {}};
    z.carryItself(2);
    const float *u = rows_[0].row(j, k - 1, made[5]), *uNext = rows_[0].row(j, k, made[6]);
    z.setSides(0, u, uNext, u + 1, uNext + 1);
    z.setSides(1, rows_[1].row(j, k - 1, made[7]), rows_[1].row(j, k, made[8]), rows_[1].row(j + 1, k - 1, made[9]),
               rows_[1].row(j + 1, k, made[10]));
    const float gained = force(2);
    accelerate(2, z, j, k, [=](std::int64_t) { return gained; });
  }

  template <class Gained>
  void accelerate(int axis, const Stencil& stencil, int j, int k, const Gained& gained) const {
    const float* open = openRow(gas_.solid, axis, j, k);
    Grid3<float>& out = out_.component(axis);
    carry(stencil, open, out.size.x, &out(0, j, k), gained);
  }

  template <class Gained>
  void carry(const Stencil& stencil, const float* open, int count, float* out, const Gained& gain) const {
    const Stencil at = stencil;  // which no store changes
    const Gained gained = gain;
    const float c = c_, weight = weight_;
    const auto fetch = [&](std::int64_t i) { fetchToRead(i + count, at.s.upper[2]); };  // the next row lies behind
    forLines(count, fetch, [&](std::int64_t i) {
      const float moved = carried(at.s, DonorShares(at.sides, weight, i), c, i) + gained(i);
      out[i] = select(open[i] > 0, moved, at.s.here[i]);
    });
  }

  const FluidState& gas_;
  const FluidSettings& settings_;
  MacVelocity& out_;
  GhostRows rows_[3];
  float c_, weight_;
  double dt_;
};
}  // namespace

bool sweepsSuffice(const FluidSettings& settings, double courant) {
  const auto* donor = std::get_if<DonorCell>(&settings.advection);
  return donor && donorStages(*donor, courant) == 1 && settings.viscosity == 0 && settings.conductivity == 0;
}

void sweepVelocity(FluidState& gas, const FluidSettings& settings, double dt, SweepScratch& scratch) {
  for (int axis = 0; axis < 3; ++axis) sizeAs(scratch.velocity.component(axis), gas.velocity.component(axis));
  const SpeedSweep sweep(gas, settings, dt, scratch.velocity);
  parallelFor(0, gas.temperature.size.z + 1, 2, [&](std::int64_t first, std::int64_t last) {
    Rooms made(gas.temperature.size.x + 1, SpeedSweep::rooms);
    for (std::int64_t k = first; k < last; ++k) sweep.plane(static_cast<int>(k), made);
  });
  std::swap(gas.velocity, scratch.velocity);
}

}  // namespace brisance
