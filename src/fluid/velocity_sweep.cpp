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
          if (j < cells_.y && k < cells_.z) {
            accelerateAll<floats>(row, room);
          } else if (k < cells_.z) {
            accelerate<floats, 1>(row, {0, cells_.x, cells_.x}, 0, room);
          } else if (j < cells_.y) {
            accelerate<floats, 2>(row, {0, cells_.x, cells_.x}, 0, room);
          }
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

  /// Lets what comes through the faces below a row wait. `later`: by how much what waits lies behind its samples.
  template <int floats, int component, int axis>
  void await(const Row& at, const RowPart& part, std::int64_t later, Room& room) const {
    awaitRow<floats>(part, facesBelow<component, axis>(at.j, at.k, room), weight_,
                     room.waiting(component, axis, at.inStrip) + later);
  }

  /// A part of a row of one component.
  template <int floats, int component>
  void accelerate(const Row& at, const RowPart& part, std::int64_t later, Room& room) const {
    if (at.firstRow) await<floats, component, 1>(at, part, later, room);
    if (at.firstPlane) await<floats, component, 2>(at, part, later, room);
    const int j = at.j, k = at.k;
    const float *here = room.old.row(component, j, k), *next = here + 1;
    const float *before = room.old.row(0, j - (component == 1), k - (component == 2)) + (component == 0 ? 0 : 1),
                *beside = room.old.row(0, j, k) + 1;
    const FaceRow<2> y = facesBelow<component, 1>(j + 1, k, room), z = facesBelow<component, 2>(j, k + 1, room);
    const SpeedsAbove<2> speeds{{{before, beside}, {y.speed[0], y.speed[1]}, {z.speed[0], z.speed[1]}}};
    const SamplesAbove samples{
        here,
        {next, y.above, z.above},
        {nullptr, room.waiting(component, 1, at.inStrip) + later, room.waiting(component, 2, at.inStrip) + later}};
    const float force = static_cast<float>(dt_ * settings_.force[component]);
    if (component != 1 || settings_.buoyancy == 0)
      return carry<floats, component>(at, part, speeds, samples,
                                      [=]<int n>(std::int64_t, auto& gained) { gained += force; });
    const Lift lift(gas_.temperature, settings_, dt_, j, k);
    carry<floats, component>(at, part, speeds, samples, [=]<int n>(std::int64_t i, auto& gained) {
      using V = NamedVectors<n>;
      const typename V::Type below = V::at(lift.below + i), above = V::at(lift.above + i);
      typename V::Type lifted;
      lift.between(below, above, lifted);
      gained += force + lifted;
    });
  }

  template <int floats, int component, class Gain>
  void carry(const Row& at, const RowPart& part, const SpeedsAbove<2>& speedsAbove, const SamplesAbove& samples,
             const Gain& gain) const {
    const float* open = openRow(gas_.solid, component, at.j, at.k);
    float* to = &out_.component(component)(0, at.j, at.k);
    const SamplesAbove fields[1] = {samples};
    carryRow<floats>(
        part, speedsAbove, fields, weight_, c_, [](std::int64_t) {},
        [=]<int n>(std::int64_t i, const auto& carried) {
          using V = NamedVectors<n>;
          typename V::Type moved = carried[0];
          gain.template operator()<n>(i, moved);
          const typename V::Type share = V::at(open + i), here = V::at(samples.here + i);
          V::at(to + i) = share > 0 ? moved : here;
        });
  }

  /// Where a row of a component goes.
  struct To {
    float *row, *waitingY, *waitingZ;
    const float *open, *copiedLater;
    float force;
  };
  template <int component>
  To rowTo(const Row& at, Room& room) const {
    const Grid3<float>& from = gas_.velocity.component(component);
    return {&out_.component(component)(0, at.j, at.k),
            room.waiting(component, 1, at.inStrip),
            room.waiting(component, 2, at.inStrip),
            openRow(gas_.solid, component, at.j, at.k),
            &from.values[0] + from.index(0, at.j + rowsAhead + 2, at.k + 1),
            static_cast<float>(dt_ * settings_.force[component])};
  }

  /// All components of a row of cells, in one loop: what they are carried by is the same numbers, added otherwise.
  template <int floats>
  void accelerateAll(const Row& at, Room& room) const {
    const std::int64_t count = cells_.x;
    const RowPart all{0, count, count};
    if (at.firstRow) {
      await<floats, 0, 1>(at, all, 0, room);
      await<floats, 1, 1>(at, all, 0, room);
      await<floats, 2, 1>(at, all, 0, room);
    }
    if (at.firstPlane) {
      await<floats, 0, 2>(at, all, 0, room);
      await<floats, 1, 2>(at, all, 0, room);
      await<floats, 2, 2>(at, all, 0, room);
    }
    if (count < floats)
      carryAll<1>(at, room);
    else
      carryAll<floats>(at, room);
    // The box's last face along x: what waits for it lies behind what waits for all others.
    const std::int64_t later = (count + lineFloats - 1) / lineFloats * lineFloats - count;
    accelerate<1, 0>(at, {count, count + 1, count + 1}, later, room);
  }

  template <int floats>
  void carryAll(const Row& at, Room& room) const {
    using V = NamedVectors<floats>;
    using Vector = typename V::Type;
    const int j = at.j, k = at.k;
    RowRing<3, 3>& old = room.old;
    const float *u = old.row(0, j, k), *uBack = old.row(0, j - 1, k), *uDown = old.row(0, j, k - 1),
                *uForth = old.row(0, j + 1, k), *uUp = old.row(0, j, k + 1);
    const float *v = old.row(1, j, k), *vForth = old.row(1, j + 1, k), *vUp = old.row(1, j, k + 1),
                *vForthDown = old.row(1, j + 1, k - 1);
    const float *w = old.row(2, j, k), *wForth = old.row(2, j + 1, k), *wUp = old.row(2, j, k + 1),
                *wBackUp = old.row(2, j - 1, k + 1);
    const To toU = rowTo<0>(at, room), toV = rowTo<1>(at, room), toW = rowTo<2>(at, room);
    const Lift lift(gas_.temperature, settings_, dt_, j, k);
    const float weight = weight_, c = c_;
    const std::int64_t count = cells_.x;
    Vector before[3];
    const auto begin = [&](std::int64_t i) {
      awaitAlongX<floats>(u[i - 1] + u[i], u[i - 1], u[i], weight, before[0]);
      awaitAlongX<floats>(uBack[i] + u[i], v[i - 1], v[i], weight, before[1]);
      awaitAlongX<floats>(uDown[i] + u[i], w[i - 1], w[i], weight, before[2]);
    };
    const auto carry = [&](std::int64_t i, std::int64_t slot, const DonorFaces<floats>& faces, const Vector& here,
                           const Vector(&rise)[3], const To& to, Vector& from, const Vector& gained) {
      Vector moved;
      carryBlock<floats>(faces, here, rise, c, to.waitingY + slot, to.waitingZ + slot, from, moved);
      moved += gained;
      const Vector share = V::at(to.open + i);
      V::at(to.row + i) = share > 0 ? moved : here;
    };
    const auto block = [&](std::int64_t i, std::int64_t slot) {
      fetchToRead(i, toU.copiedLater, toV.copiedLater, toW.copiedLater);
      fetchToRead(i + count, lift.above);
      fetchToWrite(i + count, toU.row, toV.row, toW.row);  // the next row lies behind
      const Vector uHere = V::at(u + i), uNext = V::at(u + i + 1), vHere = V::at(v + i), vAbove = V::at(vForth + i),
                   wHere = V::at(w + i), wAbove = V::at(wUp + i);
      {
        const Vector x = uHere + uNext, y = V::at(vForth + i - 1) + vAbove, z = V::at(wUp + i - 1) + wAbove;
        const Vector rise[3] = {uNext - uHere, V::at(uForth + i) - uHere, V::at(uUp + i) - uHere};
        carry(i, slot, {{x, weight}, {y, weight}, {z, weight}}, uHere, rise, toU, before[0], Vector{} + toU.force);
      }
      {
        const Vector x = V::at(uBack + i + 1) + uNext, y = vHere + vAbove, z = V::at(wBackUp + i) + wAbove;
        const Vector rise[3] = {V::at(v + i + 1) - vHere, vAbove - vHere, V::at(vUp + i) - vHere};
        const Vector one = V::at(lift.below + i), other = V::at(lift.above + i);
        Vector lifted;
        lift.between(one, other, lifted);
        carry(i, slot, {{x, weight}, {y, weight}, {z, weight}}, vHere, rise, toV, before[1], toV.force + lifted);
      }
      {
        const Vector x = V::at(uDown + i + 1) + uNext, y = V::at(vForthDown + i) + vAbove, z = wHere + wAbove;
        const Vector rise[3] = {V::at(w + i + 1) - wHere, V::at(wForth + i) - wHere, wAbove - wHere};
        carry(i, slot, {{x, weight}, {y, weight}, {z, weight}}, wHere, rise, toW, before[2], Vector{} + toW.force);
      }
    };
    std::int64_t i = 0;
    begin(0);
#pragma GCC unroll 1
    for (; i + floats <= count; i += floats) block(i, i);
    if (i == count) return;
    begin(count - floats);
    block(count - floats, i);
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
