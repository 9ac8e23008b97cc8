#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/carried_row.h"
#include "fluid/cooling.h"
#include "fluid/donor_cell.h"
#include "fluid/donor_sweep.h"
#include "fluid/ghost_rows.h"
#include "fluid/scalar_row.h"
#include "fluid/solid_rows.h"
#include "fluid/sweep_strips.h"

namespace brisance {

namespace {
class ScalarSweep {
 public:
  ScalarSweep(const FluidState& gas, const FluidSettings& settings, const Burning& burning, double dt,
              SweepScratch& scratch)
      : gas_(gas),
        out_(scratch),
        size_(gas.temperature.size),
        rows_{fieldRows(gas.temperature, settings.ambientTemperature, settings.faces),
              fieldRows(gas.soot, 0, settings.faces), fieldRows(gas.flame, 0, settings.faces)},
        heat_(settings, dt),
        ambient_(static_cast<float>(settings.ambientTemperature)),
        c_(static_cast<float>(dt / settings.cellSize) / 2),
        weight_(upwindWeightOf(settings)),
        dt_(static_cast<float>(dt)),
        sootPerRate_(static_cast<float>(burning.sootPerMass * dt)),
        flameKept_(static_cast<float>(portableExp(-dt / burning.flameLifetime))) {}

  HeatSums strip(const SweepStrip& strip, ScalarRoom& room) const {
    double outward = 0;
    for (int k = strip.firstPlane; k < strip.endPlane; ++k)
      for (int j = strip.firstRow; j < strip.endRow; ++j)
        runWithVectors([&]<int floats>() {
          if (j == strip.firstRow) begin<floats>(1, j, k, 0, room);
          if (k == strip.firstPlane) begin<floats>(2, j, k, j - strip.firstRow, room);
          const ScalarRow row = rowAt(j, k, j == strip.firstRow, room);
          if (row.inside)
            stepRow<floats, true>(row, j - strip.firstRow, room);
          else
            stepRow<floats, false>(row, j - strip.firstRow, room);
          outward += outwardFlux(row, room);
        });
    return {room.gained.take(), room.heated.take(), room.radiated.take(), room.created.take(), outward,
            room.hottest.take()};
  }

 private:
  GhostRows fieldRows(const Grid3<float>& samples, double ambient, const Faces& faces) const {
    return {samples, -1, static_cast<float>(ambient), gas_.velocity, faces};
  }

  /// Lets what comes through the faces below a row along y or z wait for it.
  template <int floats>
  void begin(int axis, int j, int k, int inStrip, ScalarRoom& room) const {
    const float* speed = axis == 1 ? &gas_.velocity.v(0, j, k) : &gas_.velocity.w(0, j, k);
    for (int n = 0; n < fields; ++n) {
      const float *below = rows_[n].row(j - (axis == 1), k - (axis == 2), room.beyond[0]),
                  *above = rows_[n].row(j, k, nullptr);
      awaitRow<floats>(size_.x, FaceRow<1>{{speed}, below, above}, weight_, room.waiting(n, axis, inStrip));
    }
  }

  /// A copy of a field's row with ghosts at its ends, which lasts until the next but one is made.
  const float* ended(int field, int j, int k, ScalarRoom& room) const {
    return rows_[field].withEnds(j, k, room.ended[2 * field + j % 2]);
  }
  /// Of a row of which `ended` was called.
  static const float* endedBefore(int field, int j, ScalarRoom& room) {
    return room.ended[2 * field + j % 2] + lineFloats;
  }

  ScalarRow rowAt(int j, int k, bool first, ScalarRoom& room) const {
    if (first)
      for (int n = 0; n < fields; ++n) ended(n, j, k, room);
    const MacVelocity& m = gas_.velocity;
    return {j,
            k,
            endedBefore(0, j, room),
            {&m.u(0, j, k), &m.v(0, j, k), &m.w(0, j, k)},
            {&m.u(0, j, k) + 1, &m.v(0, j + 1, k), &m.w(0, j, k + 1)},
            solidsOfRow(gas_.solid, j, k),
            &gas_.heatRate(0, j, k),
            &gas_.burnRate(0, j, k),
            &out_.temperature(0, j, k),
            &out_.soot(0, j, k),
            &out_.flame(0, j, k)};
  }
  template <int field>
  SamplesAbove samplesAt(int j, int k, int inStrip, ScalarRoom& room) const {
    const float* here = endedBefore(field, j, room);
    const float* next = j + 1 < size_.y ? ended(field, j + 1, k, room) : rows_[field].row(j + 1, k, room.beyond[field]);
    return {here,
            {here + 1, next, rows_[field].row(j, k + 1, room.beyond[fields + field])},
            {nullptr, room.waiting(field, 1, inStrip), room.waiting(field, 2, inStrip)}};
  }

  template <int floats, bool solids>
  void stepRow(const ScalarRow& row, int inStrip, ScalarRoom& room) const {
    const Warmth warmth = move<floats, solids>(row, inStrip, room);
    if (warmth.changes) heat<solids>(row, room);
    if (warmth.any)
      account<solids>(row, room);
    else
      room.hottest.parts()[0] = std::max(room.hottest.parts()[0], std::abs(ambient_));
  }

  /// All three by the same shares; solid cells keep their temperature.
  template <int floats, bool solids>
  Warmth move(const ScalarRow& at, int inStrip, ScalarRoom& room) const {
    const ScalarRow row = at;  // which no store changes
    const SamplesAbove samples[fields] = {samplesAt<0>(at.j, at.k, inStrip, room),
                                          samplesAt<1>(at.j, at.k, inStrip, room),
                                          samplesAt<2>(at.j, at.k, inStrip, room)};
    const float dt = dt_, sootPerRate = sootPerRate_, flameKept = flameKept_, ambient = ambient_;
    const int count = size_.x;
    const auto fetch = [=](std::int64_t i) {
      i += count;  // the next row lies behind
      fetchToRead(i, samples[0].above[2], samples[1].above[2], samples[2].above[2], row.heatRate, row.burnRate);
      fetchToRead(i, row.lowerFace[0], row.upperFace[1], row.upperFace[2]);
      fetchToWrite(i, row.newTemperature, row.newSoot, row.newFlame);
    };
    WarmthByPlace warmth;
    carryRow<floats>(count, SpeedsAbove<1>{{{row.upperFace[0]}, {row.upperFace[1]}, {row.upperFace[2]}}}, samples,
                     weight_, c_, fetch, [&, row]<int n>(std::int64_t i, const auto& carried) {
                       using V = NamedVectors<n>;
                       typename V::Type moved[fields] = {carried[0], carried[1], carried[2]};
                       if constexpr (solids) {
                         typename V::Bits solid;
                         V::whereSet(row.inside + i, solid);
                         for (int field = 0; field < fields; ++field) {
                           const typename V::Type here = V::at(samples[field].here + i);
                           moved[field] = solid ? here : moved[field];
                         }
                       }
                       const typename V::Type burnt = V::at(row.burnRate + i), T = V::at(samples[0].here + i),
                                              rate = V::at(row.heatRate + i);
                       V::at(row.newTemperature + i) = moved[0];
                       V::at(row.newSoot + i) = moved[1] + sootPerRate * burnt;
                       V::at(row.newFlame + i) = moved[2] * flameKept + dt * burnt;
                       const typename V::Type same = typename V::Type{} + ambient;
                       typename V::Type heated;
                       V::magnitude(rate, heated);
                       V::bitsAt(warmth.wasWarm) |= V::bitsOf(T) ^ V::bitsOf(same);
                       V::bitsAt(warmth.changes) |= (V::bitsOf(moved[0]) ^ V::bitsOf(same)) | V::bitsOf(heated);
                     });
    return warmth.ofAll();
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
    const float *T = row.temperature, *newT = row.newTemperature, ambient = ambient_;
    const std::uint8_t* inside = row.inside;
    const ScalarRow faces = row;  // which no store changes
    double *gained = room.gained.parts(), *created = room.created.parts();
    float* hottest = room.hottest.parts();
    const int count = size_.x;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const float brought = (T[i] - ambient) * faces.divergence(i), magnitude = std::abs(newT[i]);
      gained[i] += static_cast<double>(newT[i] - T[i]);  // 0 in solids
      created[i] += static_cast<double>(solids && inside[i] ? 0 : brought);
      hottest[i] = magnitude > hottest[i] ? magnitude : hottest[i];
    }
  }

  /// Through those of the box's faces that the row lies at.
  double outwardFlux(const ScalarRow& row, ScalarRoom& room) const {
    const int n = size_.x;
    const int place[3] = {0, row.j, row.k};
    const float* T = row.temperature;
    double sum = 0;
    const auto through = [&](const float* speed, const float* below, const float* above, int i) {
      return donorFlux(speed[i], below[i] - ambient_, above[i] - ambient_, weight_);
    };
    sum += through(row.upperFace[0], T, T + 1, n - 1) - through(row.lowerFace[0], T - 1, T, 0);
    const auto beside = [&](int axis, int step) {
      return rows_[0].row(row.j + (axis == 1 ? step : 0), row.k + (axis == 2 ? step : 0), room.beyond[2 * fields]);
    };
    for (const int axis : {1, 2}) {
      if (place[axis] == 0) {
        const float* below = beside(axis, -1);
        for (int i = 0; i < n; ++i) sum -= through(row.lowerFace[axis], below, T, i);
      }
      if (place[axis] + 1 == size_[axis]) {
        const float* above = beside(axis, 1);
        for (int i = 0; i < n; ++i) sum += through(row.upperFace[axis], T, above, i);
      }
    }
    return sum;
  }

  const FluidState& gas_;
  SweepScratch& out_;
  Vec3i size_;
  GhostRows rows_[fields];
  HeatRow heat_;
  float ambient_, c_, weight_, dt_, sootPerRate_, flameKept_;
};
}  // namespace

Balance sweepScalars(FluidState& gas, const FluidSettings& settings, const Burning& burning, double dt,
                     SweepScratch& scratch, double& hottest) {
  for (Grid3<float>* grid : {&scratch.temperature, &scratch.soot, &scratch.flame}) sizeAs(*grid, gas.temperature);
  const ScalarSweep sweep(gas, settings, burning, dt, scratch);
  const SweepStrips strips(gas.temperature.size);
  std::vector<HeatSums> parts(strips.count());
  parallelFor(0, std::ssize(parts), 1, [&](std::int64_t first, std::int64_t last) {
    ScalarRoom room(gas.temperature.size.x, strips.rowsPerStrip());
    for (std::int64_t n = first; n < last; ++n) parts[n] = sweep.strip(strips[static_cast<int>(n)], room);
  });
  HeatSums sums;
  for (const HeatSums& part : parts) sums += part;
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
