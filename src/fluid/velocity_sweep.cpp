#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/advection.h"
#include "fluid/carried_row.h"
#include "fluid/donor_sweep.h"
#include "fluid/forces.h"
#include "fluid/made_rows.h"
#include "fluid/row_ring.h"
#include "fluid/solid_rows.h"
#include "fluid/sweep_strips.h"

namespace brisance {

namespace {
/// The old velocity's rows, and what accelerates the new one.
class SpeedSweep {
 public:
  SpeedSweep(const FluidState& gas, const FluidSettings& settings, double dt, MacVelocity& out)
      : gas_(gas),
        settings_(settings),
        out_(out),
        cells_(gas.temperature.size),
        rows_{componentRows(0), componentRows(1), componentRows(2)},
        c_(static_cast<float>(dt / settings.cellSize) / 4),
        weight_(upwindWeightOf(settings)),
        dt_(dt) {}

  /// Scratch of one thread.
  class Room {
   public:
    Room(int cells, int rows) : old(cells + 1, rows), planeEnd_(cells + 1, 3 * (rows + 1)), rowEnd_(cells + 1, 3) {}
    /// Of a component: what waits along y for its next row, along z for row `row` of the next plane.
    float* waiting(int component, int axis, int row) {
      return axis == 1 ? rowEnd_[component] : planeEnd_[3 * row + component];
    }
    RowRing<3, 3> old;

   private:
    Rooms planeEnd_, rowEnd_;
  };

  /// The strip's faces along x, those below its cells along y and z, and the box's last.
  void strip(const SweepStrip& strip, Room& room) const {
    const int endRow = strip.endRow + (strip.endRow == cells_.y),
              endPlane = strip.endPlane + (strip.endPlane == cells_.z);
    room.old.begin(strip);
    for (const int k : {strip.firstPlane - 1, strip.firstPlane})
      for (int j = strip.firstRow - 1; j <= endRow; ++j) runWide([&] { fill(j, k, room); });
    for (int k = strip.firstPlane; k < endPlane; ++k) {
      for (int j = strip.firstRow - 1; j < strip.firstRow + rowsAhead; ++j) runWide([&] { fill(j, k + 1, room); });
      for (int j = strip.firstRow; j < endRow; ++j)
        runWithVectors([&]<int floats>() {
          if (j + rowsAhead <= endRow) fill(j + rowsAhead, k + 1, room);
          const Row row{j, k, j - strip.firstRow, j == strip.firstRow, k == strip.firstPlane};
          if (j < cells_.y && k < cells_.z) accelerate<floats, 0>(row, room);
          if (k < cells_.z) accelerate<floats, 1>(row, room);
          if (j < cells_.y) accelerate<floats, 2>(row, room);
        });
    }
  }

 private:
  static constexpr int rowsAhead = 2;  // so that what was stored is in the cache when it is read

  struct Row {
    int j, k, inStrip;
    bool firstRow, firstPlane;  ///< of a strip
  };
  GhostRows componentRows(int axis) const {
    return {gas_.velocity.component(axis), axis, static_cast<float>(settings_.wind[axis]), gas_.velocity,
            settings_.faces};
  }
  /// Rows of all components at (j, k), where there are such or they are ghosts of some.
  void fill(int j, int k, Room& room) const {
    for (int component = 0; component < 3; ++component) {
      const Vec3i size = gas_.velocity.component(component).size;
      const bool rowBeyond = j < 0 || j >= size.y, planeBeyond = k < 0 || k >= size.z;
      if (j > size.y || k > size.z || (rowBeyond && planeBeyond)) continue;
      room.old.fill(component, rows_[component], gas_.velocity, j, k);
    }
  }

  // Components and axes are known to the compiler below, so that it keeps what it knows of rows in registers: copies of
  // addresses just written wait until all numbers written before are in the cache.

  /// The row of a component's faces below (j, k) along y or z.
  template <int component, int axis>
  FaceRow<2> facesBelow(int j, int k, Room& room) const {
    RowRing<3, 3>& old = room.old;
    const float *below = old.row(component, j - (axis == 1), k - (axis == 2)), *above = old.row(component, j, k);
    if constexpr (component == axis) return {{below, above}, below, above};
    const float* across = old.row(axis, j, k);
    if constexpr (component == 0) return {{across - 1, across}, below, above};
    return {{old.row(axis, j - (component == 1), k - (component == 2)), across}, below, above};
  }

  template <int floats, int component, int axis>
  void await(const Row& at, Room& room) const {
    const std::int64_t count = out_.component(component).size.x;
    awaitRow<floats>({0, count, count}, facesBelow<component, axis>(at.j, at.k, room), weight_,
                     room.waiting(component, axis, at.inStrip));
  }

  template <int floats, int component>
  void accelerate(const Row& at, Room& room) const {
    if (at.firstRow) await<floats, component, 1>(at, room);
    if (at.firstPlane) await<floats, component, 2>(at, room);
    const int j = at.j, k = at.k;
    const float *here = room.old.row(component, j, k), *next = here + 1;
    const float *before = room.old.row(0, j - (component == 1), k - (component == 2)) + (component == 0 ? 0 : 1),
                *beside = room.old.row(0, j, k) + 1;
    const FaceRow<2> y = facesBelow<component, 1>(j + 1, k, room), z = facesBelow<component, 2>(j, k + 1, room);
    const SpeedsAbove<2> speeds{{{before, beside}, {y.speed[0], y.speed[1]}, {z.speed[0], z.speed[1]}}};
    const SamplesAbove samples{
        here,
        {next, y.above, z.above},
        {nullptr, room.waiting(component, 1, at.inStrip), room.waiting(component, 2, at.inStrip)}};
    const float force = static_cast<float>(dt_ * settings_.force[component]);
    if (component != 1 || settings_.buoyancy == 0)
      return carry<floats, component>(at, speeds, samples, [=]<int n>(std::int64_t, auto& gained) { gained += force; });
    const Lift lift(gas_.temperature, settings_, dt_, j, k);
    const std::int64_t count = cells_.x;
    carry<floats, component>(at, speeds, samples, [=]<int n>(std::int64_t i, auto& gained) {
      using V = NamedVectors<n>;
      fetchToRead(i + count, lift.above);
      const typename V::Type below = V::at(lift.below + i), above = V::at(lift.above + i);
      typename V::Type lifted;
      lift.between(below, above, lifted);
      gained += force + lifted;
    });
  }

  template <int floats, int component, class Gain>
  void carry(const Row& at, const SpeedsAbove<2>& speedsAbove, const SamplesAbove& samples, const Gain& gain) const {
    const float* open = openRow(gas_.solid, component, at.j, at.k);
    Grid3<float>& out = out_.component(component);
    float* to = &out(0, at.j, at.k);
    const std::int64_t count = out.size.x;
    const SamplesAbove fields[1] = {samples};
    const Grid3<float>& from = gas_.velocity.component(component);
    const float* copiedLater = &from.values[0] + from.index(0, at.j + rowsAhead + 2, at.k + 1);
    const auto fetch = [=](std::int64_t i) {
      fetchToRead(i, copiedLater);
      fetchToWrite(i + count, to);  // the next row lies behind
    };
    carryRow<floats>({0, count, count}, speedsAbove, fields, weight_, c_, fetch,
                     [=]<int n>(std::int64_t i, const auto& carried) {
                       using V = NamedVectors<n>;
                       typename V::Type moved = carried[0];
                       gain.template operator()<n>(i, moved);
                       const typename V::Type share = V::at(open + i), here = V::at(samples.here + i);
                       V::at(to + i) = share > 0 ? moved : here;
                     });
  }

  const FluidState& gas_;
  const FluidSettings& settings_;
  MacVelocity& out_;
  Vec3i cells_;
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
  const Vec3i cells = gas.temperature.size;
  const SweepStrips strips(cells);
  parallelFor(0, strips.count(), 1, [&](std::int64_t first, std::int64_t last) {
    SpeedSweep::Room room(cells.x, strips.rowsPerStrip());
    for (std::int64_t n = first; n < last; ++n) sweep.strip(strips[static_cast<int>(n)], room);
  });
  std::swap(gas.velocity, scratch.velocity);
}

}  // namespace brisance
