#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/carried_row.h"
#include "fluid/cooling.h"
#include "fluid/donor_cell.h"
#include "fluid/donor_sweep.h"
#include "fluid/ghost_rows.h"
#include "fluid/scalar_row.h"
#include "fluid/solid_rows.h"

namespace brisance {

namespace {
class ScalarSweep {
 public:
  ScalarSweep(FluidState& gas, const FluidSettings& settings, const Burning& burning, double dt,
              const ChangingSpans& spans, const OldPlanes& oldPlanes)
      : gas_(gas),
        spans_(spans),
        oldPlanes_(oldPlanes),
        size_(gas.temperature.size),
        rows_{fieldRows(gas.temperature, settings.ambientTemperature, settings.faces),
              fieldRows(gas.soot, 0, settings.faces), fieldRows(gas.flame, 0, settings.faces)},
        aroundY_(settings.faces[2] == FaceKind::periodic),
        heat_(settings, dt),
        ambient_(static_cast<float>(settings.ambientTemperature)),
        c_(static_cast<float>(dt / settings.cellSize) / 2),
        weight_(upwindWeightOf(settings)),
        dt_(static_cast<float>(dt)),
        sootPerRate_(static_cast<float>(burning.sootPerMass * dt)),
        flameKept_(static_cast<float>(portableExp(-dt / burning.flameLifetime))) {}

  HeatSums slab(int number, const Slab& slab, ScalarRoom& room) const {
    room.planeEnd.clear();
    double hottest = 0;
    for (int k = slab.first; k < slab.end; ++k) {
      room.rowEnd.clear();
      room.held = -1;
      if (aroundY_) keepFirstRow(k, room);
      for (int j = 0; j < size_.y; ++j) {
        const RowSpan span = spans_.at(j, k);
        if (span.first > 0 || span.end < size_.x) hottest = std::abs(ambient_);
        if (!span.empty())
          runWithVectors([&]<int floats>() {
            sweepRow<floats>({number, j, k, k == slab.first, k + 1 == slab.end}, span, room);
          });
      }
    }
    HeatSums sums = room.take();
    sums.hottest = std::max(sums.hottest, hottest);
    return sums;
  }

 private:
  struct Place {
    int slab, j, k;
    bool first, last;  ///< plane of the slab
  };
  GhostRows fieldRows(const Grid3<float>& samples, double ambient, const Faces& faces) const {
    return {samples, -1, static_cast<float>(ambient), gas_.velocity, faces};
  }

  template <int floats>
  void sweepRow(const Place& at, const RowSpan& span, ScalarRoom& room) const {
    if (room.held != at.j) hold(at.j, at.k, span, room);
    if (at.j == 0) begin<floats>(1, at, span, room);
    if (at.first) begin<floats>(2, at, span, room);
    if (at.j + 1 < size_.y) {
      RowSpan both = span;
      both.join(spans_.at(at.j + 1, at.k));
      hold(at.j + 1, at.k, both, room);
    }
    const ScalarRow row = rowAt(at, span, room);
    const SamplesAbove samples[scalarFields] = {samplesAt<0>(at, room), samplesAt<1>(at, room), samplesAt<2>(at, room)};
    room.outward += outwardFlux(at, row, samples[0], room);
    if (row.inside)
      stepRow<floats, true>(row, samples, room);
    else
      stepRow<floats, false>(row, samples, room);
  }

  /// Of a field: the copy of row j, which lasts until that of the next but one.
  static float* old(int field, int j, ScalarRoom& room) { return room.old[2 * field + j % 2] + lineFloats; }
  void hold(int j, int k, const RowSpan& span, ScalarRoom& room) const {
    for (int n = 0; n < scalarFields; ++n) rows_[n].copyPart(j, k, span.first, span.end, old(n, j, room));
    room.held = j;
  }
  /// In a box that is periodic along y the last row's next one, which will have changed by then.
  void keepFirstRow(int k, ScalarRoom& room) const {
    for (int n = 0; n < scalarFields; ++n) rows_[n].copyRow(0, k, room.first[n]);
  }

  // Rows of samples as they were, each only where the row at hand changes.

  const float* below(int axis, int field, const Place& at, ScalarRoom& room) const {
    const float* kept = axis == 2 && at.first ? oldPlanes_.below(at.slab, field, at.j) : nullptr;
    return kept ? kept : rows_[field].row(at.j - (axis == 1), at.k - (axis == 2), room.beyond[field]);
  }
  const float* aboveAlongY(int field, const Place& at, ScalarRoom& room) const {
    if (at.j + 1 < size_.y) return old(field, at.j + 1, room);
    return aroundY_ ? room.first[field] : rows_[field].row(at.j + 1, at.k, room.beyond[scalarFields + field]);
  }
  const float* aboveAlongZ(int field, const Place& at, ScalarRoom& room) const {
    const float* kept = at.last ? oldPlanes_.above(at.slab, field, at.j) : nullptr;
    return kept ? kept : rows_[field].row(at.j, at.k + 1, room.beyond[2 * scalarFields + field]);
  }

  /// Lets what comes through the faces below a row along y or z wait for it.
  template <int floats>
  void begin(int axis, const Place& at, const RowSpan& span, ScalarRoom& room) const {
    const float* speed = axis == 1 ? &gas_.velocity.v(0, at.j, at.k) : &gas_.velocity.w(0, at.j, at.k);
    for (int n = 0; n < scalarFields; ++n)
      awaitRow<floats>({span.first, span.end, size_.x},
                       FaceRow<1>{{speed}, below(axis, n, at, room), old(n, at.j, room)}, weight_,
                       room.waiting(n, axis, at.j));
  }

  ScalarRow rowAt(const Place& at, const RowSpan& span, ScalarRoom& room) const {
    const MacVelocity& m = gas_.velocity;
    const int j = at.j, k = at.k;
    return {j,
            k,
            span,
            {old(0, j, room), old(1, j, room), old(2, j, room)},
            {&m.u(0, j, k), &m.v(0, j, k), &m.w(0, j, k)},
            {&m.u(0, j, k) + 1, &m.v(0, j + 1, k), &m.w(0, j, k + 1)},
            solidsOfRow(gas_.solid, j, k),
            &gas_.heatRate(0, j, k),
            &gas_.burnRate(0, j, k),
            &gas_.temperature(0, j, k),
            &gas_.soot(0, j, k),
            &gas_.flame(0, j, k)};
  }
  template <int field>
  SamplesAbove samplesAt(const Place& at, ScalarRoom& room) const {
    const float* here = old(field, at.j, room);
    return {here,
            {here + 1, aboveAlongY(field, at, room), aboveAlongZ(field, at, room)},
            {nullptr, room.waiting(field, 1, at.j), room.waiting(field, 2, at.j)}};
  }

  template <int floats, bool solids>
  void stepRow(const ScalarRow& row, const SamplesAbove (&samples)[scalarFields], ScalarRoom& room) const {
    const Warmth warmth = move<floats, solids>(row, samples);
    if (warmth.changes) heat<solids>(row, room);
    if (warmth.any)
      account<solids>(row, room);
    else
      room.hottest.parts()[0] = std::max(room.hottest.parts()[0], std::abs(ambient_));
  }

  /// All three by the same shares; solid cells keep their temperature.
  template <int floats, bool solids>
  Warmth move(const ScalarRow& at, const SamplesAbove (&samples)[scalarFields]) const {
    const ScalarRow row = at;  // which no store changes
    const float dt = dt_, sootPerRate = sootPerRate_, flameKept = flameKept_, ambient = ambient_;
    const int count = size_.x;
    const auto fetch = [=](std::int64_t i) {
      i += count;  // the next row lies behind
      fetchToRead(i, samples[0].above[2], samples[1].above[2], samples[2].above[2], row.heatRate, row.burnRate);
      fetchToRead(i, row.lowerFace[0], row.upperFace[1], row.upperFace[2]);
    };
    WarmthByPlace warmth;
    carryRow<floats>({row.span.first, row.span.end, count},
                     SpeedsAbove<1>{{{row.upperFace[0]}, {row.upperFace[1]}, {row.upperFace[2]}}}, samples, weight_, c_,
                     fetch, [&, row]<int n>(std::int64_t i, const auto& carried) {
                       using V = NamedVectors<n>;
                       typename V::Type moved[scalarFields] = {carried[0], carried[1], carried[2]};
                       if constexpr (solids) {
                         typename V::Bits solid;
                         V::whereSet(row.inside + i, solid);
                         for (int field = 0; field < scalarFields; ++field) {
                           const typename V::Type here = V::at(samples[field].here + i);
                           moved[field] = solid ? here : moved[field];
                         }
                       }
                       const typename V::Type burnt = V::at(row.burnRate + i), T = V::at(samples[0].here + i),
                                              rate = V::at(row.heatRate + i);
                       V::at(row.temperature + i) = moved[0];
                       keep<n>(moved[1] + sootPerRate * burnt, row.soot + i);
                       keep<n>(moved[2] * flameKept + dt * burnt, row.flame + i);
                       const typename V::Type same = typename V::Type{} + ambient;
                       typename V::Type heated;
                       V::magnitude(rate, heated);
                       V::bitsAt(warmth.wasWarm) |= V::bitsOf(T) ^ V::bitsOf(same);
                       V::bitsAt(warmth.changes) |= (V::bitsOf(moved[0]) ^ V::bitsOf(same)) | V::bitsOf(heated);
                     });
    return warmth.ofAll();
  }

  template <int floats>
  static void keep(const typename NamedVectors<floats>::Type& density, float* to) {
    using V = NamedVectors<floats>;
    typename V::Type magnitude;
    V::magnitude(density, magnitude);
    V::at(to) = magnitude < leastDensity ? typename V::Type{} : density;
  }

  template <bool solids>
  void heat(const ScalarRow& row, ScalarRoom& room) const {
    const HeatRow heat = heat_;
    float* T = row.temperature;
    const float *H = row.heatRate, dt = dt_;
    const std::uint8_t* inside = row.inside;
    double *heated = room.heated.parts(), *radiated = room.radiated.parts();
    const int first = row.span.first, end = row.span.end;
#pragma GCC ivdep
    for (int i = first; i < end; ++i) {
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
    const float *T = row.old[0], *newT = row.temperature, ambient = ambient_;
    const std::uint8_t* inside = row.inside;
    const ScalarRow faces = row;  // which no store changes
    double *gained = room.gained.parts(), *created = room.created.parts();
    float* hottest = room.hottest.parts();
    const int first = row.span.first, end = row.span.end;
#pragma GCC ivdep
    for (int i = first; i < end; ++i) {
      const float brought = (T[i] - ambient) * faces.divergence(i), magnitude = std::abs(newT[i]);
      gained[i] += static_cast<double>(newT[i] - T[i]);  // 0 in solids
      created[i] += static_cast<double>(solids && inside[i] ? 0 : brought);
      hottest[i] = magnitude > hottest[i] ? magnitude : hottest[i];
    }
  }

  /// Through those of the box's faces that the row lies at. `above`: the temperatures beside.
  double outwardFlux(const Place& at, const ScalarRow& row, const SamplesAbove& samples, ScalarRoom& room) const {
    const float* T = samples.here;
    const int first = row.span.first, end = row.span.end;
    double sum = 0;
    const auto through = [&](const float* speed, const float* below, const float* above, int i) {
      return donorFlux(speed[i], below[i] - ambient_, above[i] - ambient_, weight_);
    };
    if (end == size_.x) sum += through(row.upperFace[0], T, T + 1, end - 1);
    if (first == 0) sum -= through(row.lowerFace[0], T - 1, T, 0);
    const int place[3] = {0, row.j, row.k};
    for (const int axis : {1, 2}) {
      if (place[axis] == 0) {
        const float* before = below(axis, 0, at, room);
        for (int i = first; i < end; ++i) sum -= through(row.lowerFace[axis], before, T, i);
      }
      if (place[axis] + 1 == size_[axis])
        for (int i = first; i < end; ++i) sum += through(row.upperFace[axis], T, samples.above[axis], i);
    }
    return sum;
  }

  FluidState& gas_;
  const ChangingSpans& spans_;
  const OldPlanes& oldPlanes_;
  Vec3i size_;
  GhostRows rows_[scalarFields];
  bool aroundY_;
  HeatRow heat_;
  float ambient_, c_, weight_, dt_, sootPerRate_, flameKept_;
};
}  // namespace

Balance sweepScalars(FluidState& gas, const FluidSettings& settings, const Burning& burning, double dt,
                     SweepScratch& scratch, double& hottest) {
  const Slabs slabs(gas.temperature.size.z);
  scratch.spans.find(gas, settings);
  scratch.oldPlanes.keep(gas, slabs, scratch.spans, settings.faces[4] == FaceKind::periodic);
  const ScalarSweep sweep(gas, settings, burning, dt, scratch.spans, scratch.oldPlanes);
  std::vector<HeatSums> parts(slabs.count());
  parallelFor(0, std::ssize(parts), 1, [&](std::int64_t first, std::int64_t last) {
    ScalarRoom room(gas.temperature.size.x, gas.temperature.size.y);
    for (int n = static_cast<int>(first); n < last; ++n) parts[n] = sweep.slab(n, slabs[n], room);
  });
  HeatSums sums;
  for (const HeatSums& part : parts) sums += part;
  hottest = sums.hottest;
  const double h = settings.cellSize, perKelvin = settings.heatCapacity * h * h * h;
  const double perFlux = settings.heatCapacity * dt * h * h;
  return {.in = perKelvin * sums.heated + perFlux * sums.created,
          .gained = perKelvin * sums.gained,
          .out = perFlux * sums.outward,
          .lost = perKelvin * sums.radiated};
}

}  // namespace brisance
