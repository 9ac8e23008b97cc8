#include "particles/particle_step.h"

#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "base/row_lines.h"
#include "base/vector_path.h"
#include "grid/interpolate_many.h"
#include "particles/way_through_cells.h"

namespace brisance {

namespace {
/// log(1 + x) / x for x >= 0, 1 at 0, without branches, so that loops over it become loops over vectors.
inline double logRatio(double x) {
  // 1 + x = 2^e m, m in [1/sqrt(2), sqrt(2)); log m = 2 atanh(s), s = (m - 1) / (m + 1), |s| < 0.1716. While e = 0, m -
  // 1 is x itself.
  constexpr std::uint64_t mantissa = (std::uint64_t{1} << 52) - 1, one = std::uint64_t{1023} << 52,
                          integer = std::uint64_t{1075} << 52;  // 2^52: a double of that exponent holds whole numbers
  constexpr double ln2High = 0x1.62e42fee00000p-1, ln2Low = 0x1.a39ef35793c76p-33;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(1 + x);
  double m = std::bit_cast<double>((bits & mantissa) | one);
  double e = std::bit_cast<double>((bits >> 52) | integer) - (0x1p52 + 1023);
  const bool high = m >= 1.4142135623730951;
  e += high ? 1 : 0;
  m *= high ? 0.5 : 1;
  const double s = (e == 0 ? x : m - 1) / (e == 0 ? x + 2 : m + 1), s2 = s * s;
  double sum = 0;
  constexpr double terms[] = {1.0 / 21, 1.0 / 19, 1.0 / 17, 1.0 / 15, 1.0 / 13,
                              1.0 / 11, 1.0 / 9,  1.0 / 7,  1.0 / 5,  1.0 / 3};
  for (const double term : terms) sum = (sum + term) * s2;
  const double logarithm = e * ln2High + (2 * s + (2 * s * sum + e * ln2Low));
  return (e == 0 ? 2 + 2 * sum : logarithm) / (e == 0 ? x + 2 : x);
}

constexpr int blockParticles = PlaceBlock::most;  // whose numbers stay in the nearest cache

/// Some particles, one array per number, so that loops over them become loops over vectors.
struct Block {
  PlaceBlock place, goal;
  CellBlock from, to;                    // the cells of place and goal
  std::int32_t meets[blockParticles];    // whether something may stand between those
  std::int32_t meeting[blockParticles];  // the particles for which it may
  WindBlock wind;
  double velocity[3][blockParticles];
  double resistance[blockParticles];  // k [1/m]; negative for what has no mass and moves with the gas
  float around[blockParticles];       // [K]
};

/// With d = g - v: d' = -k |d| d, so |d| = |d0| / (1 + k |d0| t) and its integral is d0 log(1 + k |d0| t) / (k |d0|).
/// Calls for one particle and for blocks of them come to the same bits.
struct DragFactors {
  double delay;  // of the displacement: d0 times it is lost
  double kept;   // of the difference
};
inline DragFactors dragFactors(double difference, double k, double dt) {
  const double x = k * difference * dt;
  return {dt * logRatio(x), 1 / (1 + x)};
}
inline double lengthOf(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

void dragBlock(Block& b, int count, double dt) {
  for (int n = 0; n < count; ++n) {
    const double g[3] = {b.wind.along[0][n], b.wind.along[1][n], b.wind.along[2][n]};
    const double d[3] = {g[0] - b.velocity[0][n], g[1] - b.velocity[1][n], g[2] - b.velocity[2][n]};
    const bool massless = b.resistance[n] < 0;
    const DragFactors drag = dragFactors(lengthOf(d[0], d[1], d[2]), massless ? 0 : b.resistance[n], dt);
    const double delay = massless ? 0 : drag.delay, kept = massless ? 0 : drag.kept;
    for (int axis = 0; axis < 3; ++axis) {
      b.goal.along[axis][n] = b.place.along[axis][n] + (g[axis] * dt - d[axis] * delay);
      b.velocity[axis][n] = g[axis] - d[axis] * kept;
    }
  }
}

/// Moves and heats the particles from `first` on.
class BlockStep {
 public:
  BlockStep(ParticleSet& particles, const GasAround& gas, const BurnSettings& settings, double dt)
      : p_(particles),
        gas_(gas),
        settings_(settings),
        dt_(dt),
        drag_(settings.drag * settings.radius * settings.radius),
        kept_(keptDifference(settings, dt)),
        way_(gas) {}

  void run(std::int64_t first, int count, std::uint8_t* gone) {
    runWide([&] { load(first, count); });
    const std::int64_t next = first + count;
    fetch(p_.temperature, first);
    fetch(p_.position, next);
    interpolateMany(gas_.velocity, block_.place, count, block_.wind);
    fetch(p_.velocity, next);
    fetch(p_.mass, next);
    runWide([&] {
      dragBlock(block_, count, dt_);
      way_.cellsOf(block_.place, count, block_.from);
      way_.cellsOf(block_.goal, count, block_.to);
      way_.mayMeet(block_.from, block_.to, count, block_.meets);
    });
    const int meeting = WayThroughCells::list(block_.meets, count, block_.meeting);
    for (int m = 0; m < meeting; ++m) {
      const int n = block_.meeting[m];
      gone[n] = !way_.move(block_.from, block_.to, n, block_.place, block_.goal);
    }
    interpolateMany(gas_.temperature, block_.goal, count, block_.around);
    runWide([&] { store(first, count); });
  }

 private:
  /// Asks for a field of the particles from `first` on, which are worked on next.
  template <class T>
  static void fetch(const std::vector<T>& field, std::int64_t first) {
    const std::int64_t left = static_cast<std::int64_t>(field.size()) - first;
    fetchAll(field.data() + first, std::min<std::int64_t>(left, blockParticles));
  }
  /// Share of the difference of temperatures that is left after dt.
  static double keptDifference(const BurnSettings& s, double dt) {
    if (s.thermalMass < s.thermalMassThreshold) return 0;
    return portableExp(-dt * s.heating * s.radius * s.radius / s.thermalMass);
  }

  void load(std::int64_t first, int count) {
    for (int axis = 0; axis < 3; ++axis) {
      takeAxis(&p_.position[first].x + axis, count, block_.place.along[axis]);
      takeAxis(&p_.velocity[first].x + axis, count, block_.velocity[axis]);
    }
    findResistance(p_.mass.data() + first, p_.kind.data() + first, count);
  }
  static void takeAxis(const double* places, int count, double* along) {
#pragma GCC ivdep
    for (int n = 0; n < count; ++n) along[n] = places[3 * n];
  }
  void findResistance(const double* mass, const ParticleKind* kind, int count) {
    constexpr double massless = -1;
    const double leastFuel = settings_.fuelMassThreshold, leastSoot = settings_.sootMassThreshold, drag = drag_;
    double* resistance = block_.resistance;
#pragma GCC ivdep
    for (int n = 0; n < count; ++n) {
      const double least = kind[n] == ParticleKind::fuel ? leastFuel : leastSoot;
      resistance[n] = select(mass[n] < least, massless, drag / mass[n]);
    }
  }

  void store(std::int64_t first, int count) {
    putTriples(block_.goal.along, count, &p_.position[first].x);
    putTriples(block_.velocity, count, &p_.velocity[first].x);
    heat(p_.temperature.data() + first, count);
    ignite(p_.kind.data() + first, p_.temperature.data() + first, count, p_.ignited.data() + first);
  }
  static void putTriples(const double (&along)[3][blockParticles], int count, double* places) {
#pragma GCC ivdep
    for (int n = 0; n < count; ++n) {
      places[3 * n] = along[0][n];
      places[3 * n + 1] = along[1][n];
      places[3 * n + 2] = along[2][n];
    }
  }
  void heat(double* temperature, int count) const {
    const double kept = kept_;
    const float* around = block_.around;
#pragma GCC ivdep
    for (int n = 0; n < count; ++n) temperature[n] = around[n] + (temperature[n] - around[n]) * kept;
  }
  void ignite(const ParticleKind* kind, const double* temperature, int count, std::uint8_t* ignited) const {
    const double hot = settings_.ignitionTemperature;
#pragma GCC ivdep
    for (int n = 0; n < count; ++n)
      ignited[n] |= std::uint8_t{kind[n] == ParticleKind::fuel} & std::uint8_t{temperature[n] >= hot};
  }

  ParticleSet& p_;
  const GasAround& gas_;
  const BurnSettings& settings_;
  double dt_, drag_, kept_;
  WayThroughCells way_;
  Block block_;
};
}  // namespace

Dragged dragExactly(const Vec3d& velocity, const Vec3d& gas, double k, double dt) {
  const Vec3d difference = gas - velocity;
  const DragFactors drag = dragFactors(length(difference), k, dt);
  return {gas * dt - difference * drag.delay, gas - difference * drag.kept};
}

void stepParticles(ParticleSet& p, const GasAround& gas, const BurnSettings& settings, double dt) {
  std::vector<std::uint8_t> gone(p.size());
  constexpr std::int64_t grain = 16 * blockParticles;
  parallelFor(0, static_cast<std::int64_t>(p.size()), grain, [&](std::int64_t first, std::int64_t last) {
    BlockStep step(p, gas, settings, dt);
    for (std::int64_t at = first; at < last; at += blockParticles)
      step.run(at, static_cast<int>(std::min<std::int64_t>(blockParticles, last - at)), gone.data() + at);
  });
  removeFlagged(p, gone);
}

}  // namespace brisance
