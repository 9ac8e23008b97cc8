#include "fluid/donor_sweep.h"

#include <cmath>

#include "base/aligned.h"
#include "base/lane_sum.h"
#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/advection.h"
#include "fluid/cooling.h"
#include "fluid/donor_cell.h"
#include "fluid/forces.h"
#include "fluid/ghost_rows.h"

namespace brisance {

namespace {
/// A row of samples and the rows around it.
struct Neighbours {
  const float *here, *lower[3], *upper[3];
};

/// Speeds at the two sides of a cell along each axis.
struct CellSides {
  const float *lowerFace[3], *upperFace[3];
  float lower(int axis, std::int64_t i) const { return lowerFace[axis][i]; }
  float upper(int axis, std::int64_t i) const { return upperFace[axis][i]; }
  float divergence(std::int64_t i) const {
    return (upper(0, i) - lower(0, i)) + (upper(1, i) - lower(1, i)) + (upper(2, i) - lower(2, i));
  }
};

/// At the sides of a face's control volume, which reaches from centre to centre of its two cells: means of two speeds.
struct FaceSides {
  const float *lowerPair[3][2], *upperPair[3][2];
  float lower(int axis, std::int64_t i) const { return 0.5f * (lowerPair[axis][0][i] + lowerPair[axis][1][i]); }
  float upper(int axis, std::int64_t i) const { return 0.5f * (upperPair[axis][0][i] + upperPair[axis][1][i]); }
};

/// h (u . grad) s
template <class Sides>
inline float donorRate(const Neighbours& s, const Sides& sides, float weight, std::int64_t i) {
  const auto along = [&](int axis) {
    const float here = s.here[i];
    return donorDifference({sides.lower(axis, i), sides.upper(axis, i)},
                           {here - s.lower[axis][i], s.upper[axis][i] - here}, weight);
  };
  return (along(0) + along(1)) + along(2);
}

/// Rows that are made: those beyond the box, and copies with ghosts at their ends.
class Rooms {
 public:
  explicit Rooms(int length) : width_((length + 2 + pad - 1) / pad * pad + pad), floats_(width_ * count, 0.0f) {}
  float* operator[](int n) { return floats_.data() + n * width_; }

 private:
  static constexpr std::int64_t pad = 16, count = 12;
  std::int64_t width_;
  AlignedVector<float> floats_;
};

Neighbours neighboursOf(const GhostRows& rows, int j, int k, Rooms& rooms) {
  const float* here = rows.withEnds(j, k, rooms[0]);
  return {here,
          {here - 1, rows.row(j - 1, k, rooms[1]), rows.row(j, k - 1, rooms[2])},
          {here + 1, rows.row(j + 1, k, rooms[3]), rows.row(j, k + 1, rooms[4])}};
}

/// Open shares of a row of faces. In an empty box only the box's own faces differ: rows in the cache serve for others.
const float* openRow(const SolidStamp& solid, int axis, int j, int k) {
  const Grid3<float>& open = solid.openShare.component(axis);
  return solid.empty ? &open(0, axis == 1 ? j : 0, axis == 2 ? k : 0) : &open(0, j, k);
}
const std::uint8_t* insideRow(const SolidStamp& solid, int j, int k) {
  return solid.empty ? &solid.inside(0, 0, 0) : &solid.inside(0, j, k);
}

float weightOf(const FluidSettings& settings) {
  return static_cast<float>(std::get<DonorCell>(settings.advection).upwindWeight);
}

/// Of the heat above ambient; in K, `created` and `outward` in K m/s.
struct PlaneSums {
  double gained = 0, heated = 0, radiated = 0, created = 0, outward = 0;
  void operator+=(const PlaneSums& o) {
    gained += o.gained;
    heated += o.heated;
    radiated += o.radiated;
    created += o.created;
    outward += o.outward;
  }
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
        c_(static_cast<float>(dt / settings.cellSize)),
        weight_(weightOf(settings)),
        dt_(static_cast<float>(dt)),
        sootPerRate_(static_cast<float>(burning.sootPerMass * dt)),
        flameKept_(static_cast<float>(portableExp(-dt / burning.flameLifetime))) {}

  PlaneSums plane(int k, Rooms& rooms) {
    PlaneSums sums;
    for (int j = 0; j < size_.y; ++j) row(j, k, rooms, sums);
    return sums;
  }

 private:
  CellSides sidesOf(int j, int k) const {
    const MacVelocity& m = gas_.velocity;
    return {{&m.u(0, j, k), &m.v(0, j, k), &m.w(0, j, k)}, {&m.u(0, j, k) + 1, &m.v(0, j + 1, k), &m.w(0, j, k + 1)}};
  }

  void carry(const Neighbours& s, const CellSides& sides, const std::uint8_t* inside, float* out) const {
#pragma GCC ivdep
    for (int i = 0; i < size_.x; ++i) {
      const float moved = s.here[i] - c_ * donorRate(s, sides, weight_, i);
      out[i] = inside[i] ? s.here[i] : moved;
    }
  }

  void row(int j, int k, Rooms& rooms, PlaneSums& sums) {
    const CellSides sides = sidesOf(j, k);
    const std::uint8_t* inside = insideRow(gas_.solid, j, k);
    const float *burnt = &gas_.burnRate(0, j, k), *H = &gas_.heatRate(0, j, k);
    Neighbours s = neighboursOf(temperature_, j, k, rooms);
    sums.outward += outwardFlux(s, sides, j, k);
    runWide([&] { heatRow(s, sides, inside, H, &out_.temperature(0, j, k), rooms[5], sums); });
    s = neighboursOf(soot_, j, k, rooms);
    float* soot = &out_.soot(0, j, k);
    runWide([&] {
      carry(s, sides, inside, soot);
      for (int i = 0; i < size_.x; ++i) soot[i] += sootPerRate_ * burnt[i];
    });
    s = neighboursOf(flame_, j, k, rooms);
    float* flame = &out_.flame(0, j, k);
    runWide([&] {
      carry(s, sides, inside, flame);
      for (int i = 0; i < size_.x; ++i) flame[i] = flame[i] * flameKept_ + dt_ * burnt[i];
    });
  }

  void heatRow(const Neighbours& s, const CellSides& sides, const std::uint8_t* inside, const float* H, float* T,
               float* room, PlaneSums& sums) const {
    const int n = size_.x;
    carry(s, sides, inside, T);
    const HeatRow::Sums heat = heat_(T, H, inside, n, room);
    sums.heated += heat.heated;
    sums.radiated += heat.radiated;
    sums.gained += laneSum(n, [&](std::int64_t i) { return T[i] - s.here[i]; });  // 0 in solids
    sums.created += laneSum(n, [&](std::int64_t i) {
      const float brought = (s.here[i] - ambient_) * sides.divergence(i);
      return inside[i] ? 0 : brought;
    });
  }

  /// Through those of the box's faces that the row lies at.
  double outwardFlux(const Neighbours& s, const CellSides& sides, int j, int k) const {
    const int n = size_.x;
    const int place[3] = {0, j, k};
    double sum = 0;
    const auto through = [&](const float* speed, const float* below, const float* above, int i) {
      return donorFlux(speed[i], below[i] - ambient_, above[i] - ambient_, weight_);
    };
    sum += through(sides.upperFace[0], s.here, s.upper[0], n - 1) - through(sides.lowerFace[0], s.lower[0], s.here, 0);
    for (const int axis : {1, 2}) {
      if (place[axis] == 0)
        for (int i = 0; i < n; ++i) sum -= through(sides.lowerFace[axis], s.lower[axis], s.here, i);
      if (place[axis] + 1 == size_[axis])
        for (int i = 0; i < n; ++i) sum += through(sides.upperFace[axis], s.here, s.upper[axis], i);
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

template <class T>
void sizeAs(Grid3<T>& grid, const Grid3<T>& model) {
  if (!(grid.size == model.size)) grid = model;
}
}  // namespace

bool sweepsSuffice(const FluidSettings& settings, double courant) {
  const auto* donor = std::get_if<DonorCell>(&settings.advection);
  return donor && donorStages(*donor, courant) == 1 && settings.viscosity == 0 && settings.conductivity == 0;
}

Balance sweepScalars(FluidState& gas, const FluidSettings& settings, const Burning& burning, double dt,
                     SweepScratch& scratch) {
  for (Grid3<float>* grid : {&scratch.temperature, &scratch.soot, &scratch.flame}) sizeAs(*grid, gas.temperature);
  ScalarSweep sweep(gas, settings, burning, dt, scratch);
  std::vector<PlaneSums> planes(gas.temperature.size.z);
  parallelFor(0, std::ssize(planes), 2, [&](std::int64_t first, std::int64_t last) {
    Rooms rooms(gas.temperature.size.x);
    for (std::int64_t k = first; k < last; ++k) planes[k] = sweep.plane(static_cast<int>(k), rooms);
  });
  PlaneSums sums;
  for (const PlaneSums& plane : planes) sums += plane;
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

namespace {
/// The old velocity's rows, and what accelerates the new one.
class SpeedSweep {
 public:
  SpeedSweep(const FluidState& gas, const FluidSettings& settings, double dt, MacVelocity& out)
      : gas_(gas),
        settings_(settings),
        out_(out),
        rows_{componentRows(0), componentRows(1), componentRows(2)},
        c_(static_cast<float>(dt / settings.cellSize)),
        weight_(weightOf(settings)),
        dt_(dt) {}

  void plane(int k, Rooms& rooms) {
    const Vec3i cells = gas_.temperature.size;
    for (int j = 0; j <= cells.y; ++j) {
      if (k < cells.z && j < cells.y) accelerate(0, alongX(j, k, rooms), j, k);
      if (k < cells.z) accelerate(1, alongY(j, k, rooms), j, k);
      if (j < cells.y) accelerate(2, alongZ(j, k, rooms), j, k);
    }
  }

 private:
  GhostRows componentRows(int axis) const {
    return {gas_.velocity.component(axis), axis, static_cast<float>(settings_.wind[axis]), gas_.velocity,
            settings_.faces};
  }

  struct Stencil {
    Neighbours s;
    FaceSides sides;
  };
  /// Along its own axis a component carries itself.
  static void carryItself(Stencil& stencil, int axis) {
    const Neighbours& s = stencil.s;
    stencil.sides.lowerPair[axis][0] = s.lower[axis];
    stencil.sides.lowerPair[axis][1] = stencil.sides.upperPair[axis][0] = s.here;
    stencil.sides.upperPair[axis][1] = s.upper[axis];
  }
  static void setSides(FaceSides& sides, int axis, const float* lower0, const float* lower1, const float* upper0,
                       const float* upper1) {
    sides.lowerPair[axis][0] = lower0;
    sides.lowerPair[axis][1] = lower1;
    sides.upperPair[axis][0] = upper0;
    sides.upperPair[axis][1] = upper1;
  }

  Stencil alongX(int j, int k, Rooms& rooms) const {
    Stencil x{neighboursOf(rows_[0], j, k, rooms), {}};
    carryItself(x, 0);
    const float *v = rows_[1].withEnds(j, k, rooms[5]), *vUpper = rows_[1].withEnds(j + 1, k, rooms[6]);
    const float *w = rows_[2].withEnds(j, k, rooms[7]), *wUpper = rows_[2].withEnds(j, k + 1, rooms[8]);
    setSides(x.sides, 1, v - 1, v, vUpper - 1, vUpper);
    setSides(x.sides, 2, w - 1, w, wUpper - 1, wUpper);
    return x;
  }
  Stencil alongY(int j, int k, Rooms& rooms) const {
    Stencil y{neighboursOf(rows_[1], j, k, rooms), {}};
    carryItself(y, 1);
    const float *u = rows_[0].row(j - 1, k, rooms[5]), *uNext = rows_[0].row(j, k, rooms[6]);
    setSides(y.sides, 0, u, uNext, u + 1, uNext + 1);
    setSides(y.sides, 2, rows_[2].row(j - 1, k, rooms[7]), rows_[2].row(j, k, rooms[8]),
             rows_[2].row(j - 1, k + 1, rooms[9]), rows_[2].row(j, k + 1, rooms[10]));
    return y;
  }
  Stencil alongZ(int j, int k, Rooms& rooms) const {
    Stencil z{neighboursOf(rows_[2], j, k, rooms), {}};
    carryItself(z, 2);
    const float *u = rows_[0].row(j, k - 1, rooms[5]), *uNext = rows_[0].row(j, k, rooms[6]);
    setSides(z.sides, 0, u, uNext, u + 1, uNext + 1);
    setSides(z.sides, 1, rows_[1].row(j, k - 1, rooms[7]), rows_[1].row(j, k, rooms[8]),
             rows_[1].row(j + 1, k - 1, rooms[9]), rows_[1].row(j + 1, k, rooms[10]));
    return z;
  }

  void accelerate(int axis, const Stencil& stencil, int j, int k) {
    Grid3<float>& component = out_.component(axis);
    float* out = &component(0, j, k);
    const float* open = openRow(gas_.solid, axis, j, k);
    const int count = component.size.x;
    const float force = static_cast<float>(dt_ * settings_.force[axis]);
    if (axis == 1 && settings_.buoyancy != 0) {
      const Lift lift(gas_.temperature, settings_, dt_, j, k);
      runWide([&] { carry(stencil, open, count, out, [&](std::int64_t i) { return force + lift(i); }); });
    } else {
      runWide([&] { carry(stencil, open, count, out, [&](std::int64_t) { return force; }); });
    }
  }

  template <class Gained>
  void carry(const Stencil& stencil, const float* open, int count, float* out, const Gained& gained) const {
    const Neighbours& s = stencil.s;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const float moved = (s.here[i] - c_ * donorRate(s, stencil.sides, weight_, i)) + gained(i);
      out[i] = open[i] > 0 ? moved : s.here[i];
    }
  }

  const FluidState& gas_;
  const FluidSettings& settings_;
  MacVelocity& out_;
  GhostRows rows_[3];
  float c_, weight_;
  double dt_;
};
}  // namespace

void sweepVelocity(FluidState& gas, const FluidSettings& settings, double dt, SweepScratch& scratch) {
  for (int axis = 0; axis < 3; ++axis) sizeAs(scratch.velocity.component(axis), gas.velocity.component(axis));
  SpeedSweep sweep(gas, settings, dt, scratch.velocity);
  parallelFor(0, gas.temperature.size.z + 1, 2, [&](std::int64_t first, std::int64_t last) {
    Rooms rooms(gas.temperature.size.x + 1);
    for (std::int64_t k = first; k < last; ++k) sweep.plane(static_cast<int>(k), rooms);
  });
  std::swap(gas.velocity, scratch.velocity);
}

}  // namespace brisance
