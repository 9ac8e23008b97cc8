#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/row_lines.h"
#include "base/row_sum.h"
#include "base/vector_path.h"
#include "fluid/cooling.h"
#include "fluid/donor_cell.h"
#include "fluid/donor_rows.h"
#include "fluid/donor_sweep.h"

namespace brisance {

namespace {
/// Of the heat above ambient, and the largest temperature; in K, `created` and `outward` in K m/s.
struct PlaneSums {
  double gained = 0, heated = 0, radiated = 0, created = 0, outward = 0, hottest = 0;
  void operator+=(const PlaneSums& o) {
    gained += o.gained;
    heated += o.heated;
    radiated += o.radiated;
    created += o.created;
    outward += o.outward;
    hottest = std::max(hottest, o.hottest);
  }
};

/// What one thread needs: rows beyond the box, sums.
struct ScalarRoom {
  explicit ScalarRoom(int length)
      : rows(length, 15), gained(length), heated(length), radiated(length), created(length), hottest(length) {}
  Rooms rows;
  RowSum gained, heated, radiated, created;
  RowMax hottest;
};

/// A row of cells and what is written to it.
struct ScalarRow {
  Neighbours temperature, soot, flame;
  CellSides sides;
  const std::uint8_t* inside;  ///< null: no cell is solid
  const float *heatRate, *burnRate;
  float *newTemperature, *newSoot, *newFlame;
};

class ScalarSweep {
 public:
  ScalarSweep(const FluidState& gas, const FluidSettings& settings, const Burning& burning, double dt,
              SweepScratch& scratch)
      : gas_(gas),
        out_(scratch),
        size_(gas.temperature.size),
        temperature_(gas.temperature, -1, static_cast<float>(settings.ambientTemperature), gas.velocity,
                     settings.faces),
        soot_(gas.soot, -1, 0, gas.velocity, settings.faces),
        flame_(gas.flame, -1, 0, gas.velocity, settings.faces),
        heat_(settings, dt),
        ambient_(static_cast<float>(settings.ambientTemperature)),
        c_(static_cast<float>(dt / settings.cellSize) / (2 * CellSides::perSpeed)),
        weight_(upwindWeightOf(settings)),
        dt_(static_cast<float>(dt)),
        sootPerRate_(static_cast<float>(burning.sootPerMass * dt)),
        flameKept_(static_cast<float>(portableExp(-dt / burning.flameLifetime))) {}

  PlaneSums plane(int k, ScalarRoom& room) const {
    double outward = 0;
    for (int j = 0; j < size_.y; ++j)
      runWide([&] {
        const ScalarRow row = rowAt(j, k, room);
        row.inside ? stepRow<true>(row, room) : stepRow<false>(row, room);
        outward += outwardFlux(row, j, k);
      });
    return {room.gained.take(), room.heated.take(), room.radiated.take(), room.created.take(), outward,
            room.hottest.take()};
  }

 private:
  ScalarRow rowAt(int j, int k, ScalarRoom& room) const {
    const MacVelocity& m = gas_.velocity;
    return {neighboursOf(temperature_, j, k, room.rows, 0),
            neighboursOf(soot_, j, k, room.rows, 5),
            neighboursOf(flame_, j, k, room.rows, 10),
            {{&m.u(0, j, k), &m.v(0, j, k), &m.w(0, j, k)}, {&m.u(0, j, k) + 1, &m.v(0, j + 1, k), &m.w(0, j, k + 1)}},
            solidsOfRow(gas_.solid, j, k),
            &gas_.heatRate(0, j, k),
            &gas_.burnRate(0, j, k),
            &out_.temperature(0, j, k),
            &out_.soot(0, j, k),
            &out_.flame(0, j, k)};
  }

  template <bool solids>
  void stepRow(const ScalarRow& row, ScalarRoom& room) const {
    const Warmth warmth = move<solids>(row);
    if (warmth.changes) heat<solids>(row, room);
    if (warmth.any)
      account<solids>(row, room);
    else
      room.hottest.parts()[0] = std::max(room.hottest.parts()[0], std::abs(ambient_));
  }

  /// Of a row, before and after it was carried.
  struct Warmth {
    bool any;      ///< whether a cell is not at the ambient temperature: if none is, no heat came or went
    bool changes;  ///< whether a cell is heated or cools
  };
  /// All three by the same shares; solid cells keep their temperature.
  template <bool solids>
  Warmth move(const ScalarRow& at) const {
    const ScalarRow row = at;  // which no store changes
    const float c = c_, weight = weight_, dt = dt_, sootPerRate = sootPerRate_, flameKept = flameKept_;
    const float ambient = ambient_;
    const int count = size_.x;
    std::uint32_t warm = 0, changing = 0;
    const auto fetch = [&](std::int64_t i) {
      i += count;  // the next row lies behind
      fetchToRead(i, row.temperature.upper[2], row.soot.upper[2], row.flame.upper[2], row.heatRate, row.burnRate);
      fetchToRead(i, row.sides.lowerFace[0], row.sides.lowerFace[1], row.sides.upperFace[2]);
    };
    forLines(count, fetch, [&](std::int64_t i) {
      const DonorShares share(row.sides, weight, i);
      const bool solid = solids && row.inside[i];
      const float T = row.temperature.here[i], soot = row.soot.here[i], flame = row.flame.here[i];
      const float movedT = carried(row.temperature, share, c, i), movedSoot = carried(row.soot, share, c, i),
                  movedFlame = carried(row.flame, share, c, i);
      const float burnt = row.burnRate[i], heated = row.heatRate[i], newT = select(solid, T, movedT);
      row.newTemperature[i] = newT;
      row.newSoot[i] = select(solid, soot, movedSoot) + sootPerRate * burnt;
      row.newFlame[i] = select(solid, flame, movedFlame) * flameKept + dt * burnt;
      warm |= std::uint32_t{T != ambient} | std::uint32_t{newT != ambient};
      changing |= std::uint32_t{newT > ambient} | std::uint32_t{heated != 0};
    });
    return {(warm | changing) != 0, changing != 0};
  }

  template <bool solids>
  void heat(const ScalarRow& row, ScalarRoom& room) const {
    const HeatRow heat = heat_;
    float* T = row.newTemperature;
    const float *H = row.heatRate, dt = dt_;
    const std::uint8_t* inside = row.inside;
    double *heated = room.heated.parts(), *radiated = room.radiated.parts();
    const int count = size_.x;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const bool solid = solids && inside[i];
      const float before = T[i], hot = heat.heated(before, H[i]), warm = heat.cooled(hot), rise = dt * H[i],
                  fall = hot - warm;
      heated[i] += static_cast<double>(solid ? 0 : rise);
      radiated[i] += static_cast<double>(solid ? 0 : fall);
      T[i] = solid ? before : warm;
    }
  }

  template <bool solids>
  void account(const ScalarRow& row, ScalarRoom& room) const {
    const float *T = row.temperature.here, *newT = row.newTemperature, ambient = ambient_;
    const std::uint8_t* inside = row.inside;
    const CellSides sides = row.sides;
    double *gained = room.gained.parts(), *created = room.created.parts();
    float* hottest = room.hottest.parts();
    const int count = size_.x;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const float brought = (T[i] - ambient) * sides.divergence(i), magnitude = std::abs(newT[i]);
      gained[i] += static_cast<double>(newT[i] - T[i]);  // 0 in solids
      created[i] += static_cast<double>(solids && inside[i] ? 0 : brought);
      hottest[i] = magnitude > hottest[i] ? magnitude : hottest[i];
    }
  }

  /// Through those of the box's faces that the row lies at.
  double outwardFlux(const ScalarRow& row, int j, int k) const {
    const int n = size_.x;
    const int place[3] = {0, j, k};
    const Neighbours& s = row.temperature;
    double sum = 0;
    const auto through = [&](const float* speed, const float* below, const float* above, int i) {
      return donorFlux(speed[i], below[i] - ambient_, above[i] - ambient_, weight_);
    };
    sum += through(row.sides.upperFace[0], s.here, s.upper[0], n - 1) -
           through(row.sides.lowerFace[0], s.lower[0], s.here, 0);
    for (const int axis : {1, 2}) {
      if (place[axis] == 0)
        for (int i = 0; i < n; ++i) sum -= through(row.sides.lowerFace[axis], s.lower[axis], s.here, i);
      if (place[axis] + 1 == size_[axis])
        for (int i = 0; i < n; ++i) sum += through(row.sides.upperFace[axis], s.here, s.upper[axis], i);
    }
    return sum;
  }

  const FluidState& gas_;
  SweepScratch& out_;
  Vec3i size_;
  GhostRows temperature_, soot_, flame_;
  HeatRow heat_;
  float ambient_, c_, weight_, dt_, sootPerRate_, flameKept_;
};
}  // namespace

Balance sweepScalars(FluidState& gas, const FluidSettings& settings, const Burning& burning, double dt,
                     SweepScratch& scratch, double& hottest) {
  for (Grid3<float>* grid : {&scratch.temperature, &scratch.soot, &scratch.flame}) sizeAs(*grid, gas.temperature);
  const ScalarSweep sweep(gas, settings, burning, dt, scratch);
  std::vector<PlaneSums> planes(gas.temperature.size.z);
  parallelFor(0, std::ssize(planes), 2, [&](std::int64_t first, std::int64_t last) {
    ScalarRoom room(gas.temperature.size.x);
    for (std::int64_t k = first; k < last; ++k) planes[k] = sweep.plane(static_cast<int>(k), room);
  });
  PlaneSums sums;
  for (const PlaneSums& plane : planes) sums += plane;
  hottest = sums.hottest;
  std::swap(gas.temperature.values, scratch.temperature.values);
  std::swap(gas.soot.values, scratch.soot.values);
  std::swap(gas.flame.values, scratch.flame.values);
  const double h = settings.cellSize, perKelvin = settings.heatCapacity * h * h * h;
  const double perFlux = settings.heatCapacity * dt * h * h;
  return {.in = perKelvin * sums.heated + perFlux * sums.created,
          .gained = perKelvin * sums.gained,
          .out = perFlux * sums.outward,
          .lost = perKelvin * sums.radiated};
}

}  // namespace brisance
