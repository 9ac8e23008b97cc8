#include "particles/particle_step.h"

#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "grid/interpolate_many.h"

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

/// The place that `from` reaches on its way to `to`, one axis after the other, stopping short of closed faces:
/// particles slide along walls; beyond periodic faces they go on from the opposite ones. False when it leaves the box.
bool moveThrough(const GasAround& gas, const Vec3d& from, const Vec3d& to, Vec3d& reached) {
  const MacVelocity& openShare = gas.openShare;
  const Vec3i cells = openShare.cells();
  const double h = openShare.u.cellSize;
  const Vec3d corner = openShare.u.origin - Vec3d(0, .5, .5) * h;
  constexpr double justShort = 1e-6;  // of a cell
  const double inverse = 1 / h;       // as in BlockStep, which must find particles in the same cells
  Vec3d p = (from - corner) * inverse;
  const Vec3d goal = (to - corner) * inverse;
  for (int axis = 0; axis < 3; ++axis) {
    const Grid3<float>& open = openShare.component(axis);
    int cell[3] = {static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)};
    const bool forward = goal[axis] > p[axis];
    double end = goal[axis];
    while (forward ? cell[axis] + 1 <= end : cell[axis] > end) {
      const int face = cell[axis] + (forward ? 1 : 0);
      int at[3] = {cell[0], cell[1], cell[2]};
      at[axis] = face;
      if (open(at[0], at[1], at[2]) == 0) {
        end = face + (forward ? -justShort : justShort);
        break;
      }
      cell[axis] += forward ? 1 : -1;
      if (cell[axis] >= 0 && cell[axis] < cells[axis]) continue;
      if (!gas.periodic[axis]) return false;
      const int period = forward ? -cells[axis] : cells[axis];
      cell[axis] += period;
      end += period;
    }
    p[axis] = end;
  }
  reached = corner + p * h;
  for (int axis = 0; axis < 3; ++axis)
    if (!(p[axis] >= 0 && p[axis] < cells[axis])) return false;
  return true;
}

constexpr int blockParticles = 256;  // whose numbers stay in the nearest cache

/// Some particles, one array per number, so that loops over them become loops over vectors.
struct Block {
  float wind[3][blockParticles];
  double velocity[3][blockParticles];
  double moved[3][blockParticles];
  double resistance[blockParticles];  // k [1/m]; negative for what has no mass and moves with the gas
  float around[blockParticles];       // [K]
  std::uint8_t sameCell[blockParticles];
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
    const double g[3] = {b.wind[0][n], b.wind[1][n], b.wind[2][n]};
    const double d[3] = {g[0] - b.velocity[0][n], g[1] - b.velocity[1][n], g[2] - b.velocity[2][n]};
    const bool massless = b.resistance[n] < 0;
    const DragFactors drag = dragFactors(lengthOf(d[0], d[1], d[2]), massless ? 0 : b.resistance[n], dt);
    const double delay = massless ? 0 : drag.delay, kept = massless ? 0 : drag.kept;
    for (int axis = 0; axis < 3; ++axis) {
      b.moved[axis][n] = g[axis] * dt - d[axis] * delay;
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
        corner_(gas.openShare.u.origin - Vec3d(0, .5, .5) * gas.openShare.u.cellSize),
        inverse_(1 / gas.openShare.u.cellSize) {}

  void run(std::int64_t first, int count, std::uint8_t* gone) {
    const std::span<const Vec3d> places(p_.position.data() + first, static_cast<std::size_t>(count));
    for (int axis = 0; axis < 3; ++axis) interpolateMany(gas_.velocity.component(axis), places, block_.wind[axis]);
    load(first, count);
    runWide([&] {
      dragBlock(block_, count, dt_);
      compareCells(places.data(), count);
    });
    for (int n = 0; n < count; ++n) gone[n] = !move(first + n, n);
    interpolateMany(gas_.temperature, places, block_.around);
    runWide([&] { heat(p_.temperature.data() + first, count); });
  }

 private:
  /// Share of the difference of temperatures that is left after dt.
  static double keptDifference(const BurnSettings& s, double dt) {
    if (s.thermalMass < s.thermalMassThreshold) return 0;
    return portableExp(-dt * s.heating * s.radius * s.radius / s.thermalMass);
  }

  void load(std::int64_t first, int count) {
    constexpr double massless = -1;
    for (int n = 0; n < count; ++n) {
      const std::int64_t at = first + n;
      for (int axis = 0; axis < 3; ++axis) block_.velocity[axis][n] = p_.velocity[at][axis];
      const double threshold =
          p_.kind[at] == ParticleKind::fuel ? settings_.fuelMassThreshold : settings_.sootMassThreshold;
      block_.resistance[n] = p_.mass[at] < threshold ? massless : drag_ / p_.mass[at];
    }
  }

  void compareCells(const Vec3d* places, int count) {
    std::fill_n(block_.sameCell, count, std::uint8_t{1});
    for (int axis = 0; axis < 3; ++axis)
      for (int n = 0; n < count; ++n) {
        const double from = (places[n][axis] - corner_[axis]) * inverse_;
        const double to = (places[n][axis] + block_.moved[axis][n] - corner_[axis]) * inverse_;
        block_.sameCell[n] &= static_cast<std::uint8_t>(std::floor(from) == std::floor(to));
      }
  }

  /// False when the particle leaves the box.
  bool move(std::int64_t at, int n) {
    p_.velocity[at] = {block_.velocity[0][n], block_.velocity[1][n], block_.velocity[2][n]};
    const Vec3d goal = p_.position[at] + Vec3d(block_.moved[0][n], block_.moved[1][n], block_.moved[2][n]);
    if (!block_.sameCell[n]) return moveThrough(gas_, p_.position[at], goal, p_.position[at]);
    p_.position[at] = goal;
    return true;
  }

  void heat(double* temperature, int count) const {
    for (int n = 0; n < count; ++n) temperature[n] = block_.around[n] + (temperature[n] - block_.around[n]) * kept_;
  }

  ParticleSet& p_;
  const GasAround& gas_;
  const BurnSettings& settings_;
  double dt_, drag_, kept_;
  Vec3d corner_;
  double inverse_;
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
