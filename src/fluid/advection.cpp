#include "fluid/advection.h"

#include "base/lane_sum.h"
#include "base/parallel.h"
#include "base/row_sum.h"
#include "base/vector_path.h"
#include "fluid/donor_cell.h"
#include "fluid/ghost_rows.h"
#include "fluid/semi_lagrangian.h"

namespace brisance {

namespace {
/// Rows to write to, of a grid or inside a padded one.
struct RowsOut {
  float* first;
  std::int64_t row, plane;
  explicit RowsOut(Grid3<float>& grid) : first(grid.values.data()), row(grid.stride(1)), plane(grid.stride(2)) {}
  explicit RowsOut(PaddedGrid& grid)
      : first(grid.row(0, 0)), row(grid.values.stride(1)), plane(grid.values.stride(2)) {}
  float* at(int j, int k) const { return first + j * row + k * plane; }
};

struct AllRows {
  bool operator()(int, int) const { return true; }
};
/// Those near a sample that is not the usual one.
struct RowsWithin {
  const BusyRows& busy;
  int rows;
  bool operator()(int j, int k) const { return busy.within(rows, j, k); }
};

/// Calls work(j, k) for every row that is wanted, compiled for wide vectors.
template <class Wanted, class Work>
void forRows(const Vec3i& size, const Wanted& wanted, const Work& work) {
  parallelFor(0, size.z, 1, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      runWide([&] {
        for (int j = 0; j < size.y; ++j)
          if (wanted(j, k)) work(j, k);
      });
  });
}

/// What else accelerates a quantity while it is carried: nothing.
struct NoPush {
  auto row(int, int) const {
    return [](std::int64_t) { return 0.0f; };
  }
};
/// The pressure of the step before, on a velocity component: `share` dt / h times its difference.
struct PressurePush {
  const PaddedGrid& pressure;
  int axis;
  float dtOverH;
  auto row(int j, int k) const {
    const Row p = rowOf(pressure, j, k);
    return [at = p.at, back = p.step[axis], c = dtOverH](std::int64_t i) { return c * (at[i] - at[i - back]); };
  }
};

/// out = base - c (h u . grad) from - push, c = dt / h; what is closed keeps the base.
template <class Flow, class Push, class Wanted = AllRows>
void donorStep(const Flow& flow, const PaddedGrid& base, const PaddedGrid& from, float c, float weight,
               const Push& push, RowsOut out, const Wanted& wanted = {}) {
  const int count = flow.size().x;
  forRows(flow.size(), wanted, [&](int j, int k) {
    const auto carrier = flow.row(j, k);
    const auto pushed = push.row(j, k);
    const Row s = rowOf(from, j, k);
    const float* before = base.row(j, k);
    float* after = out.at(j, k);
#pragma GCC ivdep
    for (std::int64_t i = 0; i < count; ++i) {
      const float moved = before[i] - (c * carrier.rate(s, i, weight) + pushed(i));
      after[i] = carrier.closed(i) ? before[i] : moved;
    }
  });
}

inline float lesser(float a, float b) { return a < b ? a : b; }
inline float greater(float a, float b) { return a > b ? a : b; }
/// Of a sample and its six neighbours.
inline float leastAround(const Row& s, std::int64_t i) {
  const float x = lesser(s.at[i - 1], s.at[i + 1]), y = lesser(s.at[i - s.step[1]], s.at[i + s.step[1]]),
              z = lesser(s.at[i - s.step[2]], s.at[i + s.step[2]]);
  return lesser(s.at[i], lesser(x, lesser(y, z)));
}
inline float mostAround(const Row& s, std::int64_t i) {
  const float x = greater(s.at[i - 1], s.at[i + 1]), y = greater(s.at[i - s.step[1]], s.at[i + s.step[1]]),
              z = greater(s.at[i - s.step[2]], s.at[i + s.step[2]]);
  return greater(s.at[i], greater(x, greater(y, z)));
}

/// A step back from the predicted values misses the old ones by twice what the prediction is off: with s' predicted and
/// s" reached again from it, new = s' + (s - s") / 2, where s" = s' + c (h u . grad, downwind) s'. A push that the
/// prediction has had is taken off again.
template <class Flow, class Push, class Wanted = AllRows>
void correctStep(const Flow& flow, const PaddedGrid& old, const PaddedGrid& predicted, float c, bool clamped,
                 const Push& push, RowsOut out, const Wanted& wanted = {}) {
  const int count = flow.size().x;
  constexpr float downwind = -1;
  forRows(flow.size(), wanted, [&](int j, int k) {
    const auto carrier = flow.row(j, k);
    const auto pushed = push.row(j, k);
    const Row s = rowOf(old, j, k), p = rowOf(predicted, j, k);
    const float* before = old.row(j, k);
    float* after = out.at(j, k);
#pragma GCC ivdep
    for (std::int64_t i = 0; i < count; ++i) {
      const float free = 0.5f * ((before[i] + (p.at[i] + pushed(i))) - c * carrier.rate(p, i, downwind));
      const float least = clamped ? leastAround(s, i) : free, most = clamped ? mostAround(s, i) : free;
      after[i] = carrier.closed(i) ? before[i] : lesser(greater(free, least), most);
    }
  });
}

/// What created gas brings: sum of (s - ambient) div u, times h^2 for the caller's h. All is ambient but in busy rows.
double createdContent(const PaddedGrid& scalar, const ScalarFlow& flow, float ambient, const RowsWithin& busy) {
  const Vec3i size = flow.size();
  return parallelSum(size.z, 1, [&](std::int64_t k, std::int64_t) {
    double sum = 0;
    runWide([&] {
      for (int j = 0; j < size.y; ++j) {
        if (!busy(j, static_cast<int>(k))) continue;
        const auto carrier = flow.row(j, static_cast<int>(k));
        const float* s = scalar.row(j, static_cast<int>(k));
        sum += laneSum(size.x, [&](std::int64_t i) {
          return carrier.closed(i) ? 0.0f : (s[i] - ambient) * carrier.divergence(i);
        });
      }
    });
    return sum;
  });
}

/// What leaves through one of the box's faces: sum of the outward flux of (s - ambient), times h^2 for the caller's h.
double outwardFlux(const PaddedGrid& padded, const MacVelocity& velocity, int face, float ambient, float weight,
                   const RowsWithin& busy) {
  const int axis = face / 2, b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  const Grid3<float>& normal = velocity.component(axis);
  const std::int64_t step = padded.values.stride(axis);
  const int layer = face % 2 ? normal.size[axis] - 1 : 0;
  const int cell = face % 2 ? layer - 1 : 0;  // along the axis, inside
  constexpr int rows = 32;
  const double sum = parallelSum(normal.size[c], rows, [&](std::int64_t first, std::int64_t last) {
    double part = 0;
    for (std::int64_t q = first; q < last; ++q)
      for (int p = 0; p < normal.size[b]; ++p) {
        const int other = static_cast<int>(q);
        if (!(axis == 0 ? busy(p, other) : axis == 1 ? busy(cell, other) : busy(other, cell))) continue;
        const float speed = normal.values[layer * normal.stride(axis) + p * normal.stride(b) + q * normal.stride(c)];
        const float* upper = padded.values.values.data() + (layer + 1) * step + (p + 1) * padded.values.stride(b) +
                             (q + 1) * padded.values.stride(c);
        part += donorFlux(speed, upper[-step] - ambient, upper[0] - ambient, weight);
      }
    return part;
  });
  return face % 2 ? sum : -sum;
}

double outwardFlux(const PaddedGrid& padded, const MacVelocity& velocity, float ambient, float weight,
                   const RowsWithin& busy) {
  double sum = 0;
  for (int face = 0; face < 6; ++face) sum += outwardFlux(padded, velocity, face, ambient, weight, busy);
  return sum;
}

bool isSemiLagrangian(const FluidSettings& settings) {
  return std::holds_alternative<SemiLagrangian>(settings.advection);
}

/// A scalar on its way.
struct ScalarTransport {
  const FluidState& gas;
  const FluidSettings& settings;
  float ambient;
  double dt;
  AdvectionScratch& scratch;
  Balance* balance;  ///< kept if there is one
  ScalarFlow flow{gas};

  float dtOverH() const { return static_cast<float>(dt / settings.cellSize); }
  void fillGhosts(PaddedGrid& padded, const RowsWithin& wanted) const {
    const GhostRows ends(gas.temperature, -1, ambient, gas.velocity, settings.faces);  // alike for all scalars
    forRows(flow.size(), wanted,
            [&](int j, int k) { ends.addEnds(ends.rowsOfCrossing(j, k), gas.velocity.u, padded.row(j, k)); });
    fillScalarGhosts(padded, gas.velocity, settings.faces, ambient);
  }
  /// `share` of the step carried these values, by differences of some weight.
  void account(const PaddedGrid& values, float weight, double share) const {
    if (!balance) return;
    const double perSpeed = share * dt * settings.cellSize * settings.cellSize;
    const RowsWithin busy{scratch.busy, 2};  // a pass reaches one row further, and its faces the next
    balance->in += perSpeed * createdContent(values, flow, ambient, busy);
    balance->out += perSpeed * outwardFlux(values, gas.velocity, ambient, weight, busy);
  }
  /// stage = old - part of the step by the differences of `from`
  void part(float share, const PaddedGrid& from, float weight, PaddedGrid& stage) const {
    resizePadded(stage, scratch.newScalar);
    donorStep(flow, scratch.scalar, from, share * dtOverH(), weight, NoPush{}, RowsOut(stage),
              RowsWithin{scratch.busy, 1});
    beAmbient(stage);
    fillGhosts(stage, {scratch.busy, 3});
  }
  /// Rows that are read, but not reached within a pass.
  void beAmbient(PaddedGrid& stage) const {
    const int count = flow.size().x;
    forRows(
        flow.size(), [&](int j, int k) { return scratch.busy.within(3, j, k) && !scratch.busy.within(1, j, k); },
        [&](int j, int k) { std::fill_n(stage.row(j, k), count, ambient); });
  }

  void by(const DonorCell& scheme) const {
    const float weight = static_cast<float>(scheme.upwindWeight);
    const PaddedGrid* last = &scratch.scalar;
    for (int left = donorStages(scheme, courantOfSpeeds(gas, dt)); left > 1; --left) {
      PaddedGrid& stage = scratch.stage[left % 2].component[0];
      part(1.0f / static_cast<float>(left), *last, weight, stage);
      last = &stage;
    }
    donorStep(flow, scratch.scalar, *last, dtOverH(), weight, NoPush{}, RowsOut(scratch.newScalar));
    account(*last, weight, 1);
  }
  void by(const MacCormack& scheme) const {
    PaddedGrid& predicted = scratch.stage[0].component[0];
    part(1, scratch.scalar, 1, predicted);
    correctStep(flow, scratch.scalar, predicted, dtOverH(), scheme.clamped, NoPush{}, RowsOut(scratch.newScalar),
                RowsWithin{scratch.busy, 2});
    account(scratch.scalar, 1, 0.5);
    account(predicted, -1, 0.5);
  }
  void by(const SemiLagrangian&) const {
    carryBack(gas, {settings.faces}, scratch.paths, scratch.scalar, scratch.newScalar);
    account(scratch.scalar, 1, 1);
  }
};

void carry(Grid3<float>& scalar, const ScalarTransport& transport, Paths paths) {
  AdvectionScratch& scratch = transport.scratch;
  if (paths == Paths::toTrace && isSemiLagrangian(transport.settings)) {
    scratch.velocity.fill(transport.gas.velocity, transport.settings);
    tracePaths(scratch.velocity, transport.settings.faces, transport.dt, scratch.paths);
  }
  BusyRows& busy = scratch.busy;
  if (std::holds_alternative<MacCormack>(transport.settings.advection))
    busy.find(scalar, transport.ambient, transport.settings.faces);
  else
    busy.take(scalar.size);
  resizePadded(scratch.scalar, scalar);
  forRows(scalar.size, RowsWithin{busy, 3}, [&](int j, int k) {
    std::copy_n(&scalar.values[0] + scalar.index(0, j, k), scalar.size.x, scratch.scalar.row(j, k));
  });
  transport.fillGhosts(scratch.scalar, {busy, 3});
  if (!(scratch.newScalar.size == scalar.size)) scratch.newScalar = scalar;
  std::visit([&](const auto& scheme) { transport.by(scheme); }, transport.settings.advection);
  if (busy.all()) return std::swap(scalar.values, scratch.newScalar.values);
  forRows(scalar.size, RowsWithin{busy, 2}, [&](int j, int k) {
    std::copy_n(&scratch.newScalar.values[0] + scalar.index(0, j, k), scalar.size.x,
                &scalar.values[0] + scalar.index(0, j, k));
  });
}

template <class Work>
void forAxes(const Work& work) {
  work(std::integral_constant<int, 0>{});
  work(std::integral_constant<int, 1>{});
  work(std::integral_constant<int, 2>{});
}

/// The velocity on its way. Between the passes of a scheme it is carried by itself as it is then, and made to obey the
/// pressure of the step before: otherwise an error of first order in the time step remains that damps whirls.
struct VelocityTransport {
  const FluidState& gas;
  const FluidSettings& settings;
  double dt;
  AdvectionScratch& scratch;

  float dtOverH() const { return static_cast<float>(dt / settings.cellSize); }
  void padPressure() const {
    copyInside(scratch.scalar, gas.pressure);
    fillPressureGhosts(scratch.scalar, settings.faces);
  }
  template <int axis>
  SpeedFlow<axis> flow(const PaddedVelocity& carrier) const {
    return {carrier, gas.solid.openShare.component(axis)};
  }
  /// stage = old - part of the step by the differences of `from`
  void part(float share, const PaddedVelocity& from, float weight, PaddedVelocity& stage) const {
    const float c = share * dtOverH();
    forAxes([&](auto axis) {
      PaddedGrid& to = stage.component[axis];
      resizePadded(to, gas.velocity.component(axis));
      donorStep(flow<axis>(from), scratch.velocity.component[axis], from.component[axis], c, weight,
                PressurePush{scratch.scalar, axis, c}, RowsOut(to));
      fillSpeedGhosts(to, axis, gas.velocity, settings);
    });
  }

  void by(const DonorCell& scheme) const {
    const float weight = static_cast<float>(scheme.upwindWeight);
    const PaddedVelocity* last = &scratch.velocity;
    const int stages = donorStages(scheme, courantOfSpeeds(gas, dt));
    if (stages > 1) padPressure();
    for (int left = stages; left > 1; --left) {
      PaddedVelocity& stage = scratch.stage[left % 2];
      part(1.0f / static_cast<float>(left), *last, weight, stage);
      last = &stage;
    }
    forAxes([&](auto axis) {
      donorStep(flow<axis>(*last), scratch.velocity.component[axis], last->component[axis], dtOverH(), weight, NoPush{},
                RowsOut(scratch.newVelocity.component(axis)));
    });
  }
  void by(const MacCormack& scheme) const {
    padPressure();
    part(1, scratch.velocity, 1, scratch.stage[0]);
    forAxes([&](auto axis) {
      correctStep(flow<axis>(scratch.stage[0]), scratch.velocity.component[axis], scratch.stage[0].component[axis],
                  dtOverH(), scheme.clamped, PressurePush{scratch.scalar, axis, dtOverH()},
                  RowsOut(scratch.newVelocity.component(axis)));
    });
  }
  void by(const SemiLagrangian&) const {
    for (int axis = 0; axis < 3; ++axis)
      carryBack(gas, {settings.faces, axis}, scratch.paths, scratch.velocity.component[axis],
                scratch.newVelocity.component(axis));
  }
};
}  // namespace

void advectVelocity(FluidState& gas, const FluidSettings& settings, double dt, AdvectionScratch& scratch, Paths paths) {
  scratch.velocity.fill(gas.velocity, settings);
  if (paths == Paths::toTrace && isSemiLagrangian(settings))
    tracePaths(scratch.velocity, settings.faces, dt, scratch.paths);
  if (scratch.newVelocity.u.count() != gas.velocity.u.count()) scratch.newVelocity = gas.velocity;
  const VelocityTransport transport{gas, settings, dt, scratch};
  std::visit([&](const auto& scheme) { transport.by(scheme); }, settings.advection);
  std::swap(gas.velocity, scratch.newVelocity);
}

void carryScalar(Grid3<float>& scalar, const FluidState& gas, const FluidSettings& settings, float ambient, double dt,
                 AdvectionScratch& scratch, Paths paths) {
  carry(scalar, {gas, settings, ambient, dt, scratch, nullptr}, paths);
}

Balance advectScalar(Grid3<float>& scalar, const FluidState& gas, const FluidSettings& settings, float ambient,
                     double dt, AdvectionScratch& scratch) {
  Balance balance;
  carry(scalar, {gas, settings, ambient, dt, scratch, &balance}, Paths::toTrace);
  return balance;
}

int donorStages(const DonorCell& scheme, double courant) {
  constexpr double enoughForTwo = 0.2;
  if (scheme.upwindWeight >= 1 || courant <= scheme.upwindWeight) return 1;
  return scheme.upwindWeight >= enoughForTwo ? 2 : 3;
}

namespace {
inline float largerSpeed(float a, float b) {
  a = std::abs(a), b = std::abs(b);
  return a > b ? a : b;
}
}  // namespace

double largestMagnitude(const Grid3<float>& grid) {
  return parallelMax(grid.count(), 1 << 14, [&](std::int64_t first, std::int64_t last) {
    float largest = 0;
    runWide([&] { largest = laneMax(last - first, [&](std::int64_t n) { return grid.values[first + n]; }); });
    return static_cast<double>(largest);
  });
}

double fastestCell(const FluidState& gas) {
  const Vec3i n = gas.pressure.size;
  const MacVelocity& m = gas.velocity;
  return parallelMax(std::int64_t{n.y} * n.z, 64, [&](std::int64_t first, std::int64_t last) {
    RowMax largest(n.x);
    runWide([&] {
      for (std::int64_t row = first; row < last; ++row) {
        const int j = static_cast<int>(row % n.y), k = static_cast<int>(row / n.y);
        const float *u = &m.u(0, j, k), *below = &m.v(0, j, k), *above = &m.v(0, j + 1, k), *behind = &m.w(0, j, k),
                    *before = &m.w(0, j, k + 1);
        largest.add([=](std::int64_t i) {
          return largerSpeed(u[i], u[i + 1]) + largerSpeed(below[i], above[i]) + largerSpeed(behind[i], before[i]);
        });
      }
    });
    return static_cast<double>(largest.take());
  });
}

double courantOfSpeeds(const FluidState& gas, double dt) { return dt * fastestCell(gas) / gas.pressure.cellSize; }

}  // namespace brisance
