#include "fluid/diffusion.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/vector_path.h"

namespace brisance {

namespace {
constexpr int lanes = 16;               // lines that are worked on together
constexpr double explicitLimit = 0.25;  // of k dt / h^2, where the shortest wave just vanishes

/// Beyond an end of a line: ghost = factor * (the last sample) + offset.
struct LineEnd {
  double factor = 1, offset = 0;
};

/// The lines of a grid along one axis.
struct LineSystem {
  Grid3<float>& values;
  const Grid3<float>& share;  ///< of the face below a sample; for velocities, of the sample's own face
  bool joined;                ///< share is that of the faces between samples; else a closed sample is fixed
  int axis;
  double coupling;  ///< k dt / h^2
  LineEnd lower, upper;
  int samples;    ///< unknown along a line
  bool periodic;  ///< the sample after the last is the first
};

/// Up to 16 lines side by side: sample s of line l at [s * lanes + l]. In double precision: beside a coupling of a
/// thousand, single precision keeps three digits of the 1 that holds the sum of the samples.
class LineTile {
 public:
  explicit LineTile(int samples)
      : s_(samples * lanes), below_(samples * lanes), above_(samples * lanes), end_(samples * lanes) {}

  /// `place`: sample 0 of line 0; lines follow one another along `across`.
  void load(const LineSystem& system, const Vec3i& place, int across, int lines) {
    lines_ = lines;
    const std::int64_t step = system.values.stride(system.axis), next = system.values.stride(across);
    const std::int64_t shareStep = system.share.stride(system.axis), shareNext = system.share.stride(across);
    const float* from = &system.values(place.x, place.y, place.z);
    const float* share = &system.share(place.x, place.y, place.z);
    const std::int64_t above = system.joined ? shareStep : 0;
    const auto open = [&](float part) -> double { return system.joined ? part : part > 0 ? 1 : 0; };
    for (int s = 0; s < system.samples; ++s)
      for (int l = 0; l < lines; ++l) {
        s_[s * lanes + l] = from[s * step + l * next];
        below_[s * lanes + l] = system.coupling * open(share[s * shareStep + l * shareNext]);
        above_[s * lanes + l] = system.coupling * open(share[s * shareStep + l * shareNext + above]);
      }
  }
  void store(const LineSystem& system, const Vec3i& place, int across) const {
    const std::int64_t step = system.values.stride(system.axis), next = system.values.stride(across);
    float* to = &system.values(place.x, place.y, place.z);
    for (int s = 0; s < system.samples; ++s)
      for (int l = 0; l < lines_; ++l) to[s * step + l * next] = static_cast<float>(s_[s * lanes + l]);
    if (!system.periodic || system.values.size[system.axis] == system.samples) return;
    for (int l = 0; l < lines_; ++l)
      to[system.samples * step + l * next] = static_cast<float>(s_[l]);  // the same face again
  }

  void explicitStep(const LineSystem& system) {
    double* before = end_.data();
    const int last = (system.samples - 1) * lanes;
    for (int l = 0; l < lanes; ++l)
      before[l] = system.periodic ? s_[last + l] : system.lower.factor * s_[l] + system.lower.offset;
    double first[lanes];
    std::copy_n(s_.begin(), lanes, first);
    for (int s = 0; s < system.samples; ++s)
      for (int l = 0; l < lanes; ++l) {
        const int n = s * lanes + l;
        const double here = s_[n];
        const double after = s + 1 < system.samples ? s_[n + lanes]
                             : system.periodic      ? first[l]
                                                    : system.upper.factor * here + system.upper.offset;
        s_[n] = here + (above_[n] * (after - here) - below_[n] * (here - before[l]));
        before[l] = here;
      }
  }

  /// Solves (1 + below + above) x_s - below x_(s-1) - above x_(s+1) = s by elimination. Around a periodic axis the
  /// matrix is T - e w, with e = (1, 0 .. 0, above of the last), w = (1, 0 .. 0, below of the first) and T tridiagonal
  /// (Sherman & Morrison 1950); `end` becomes e / T.
  void implicitStep(const LineSystem& system) {
    const int n = system.samples;
    eliminate(system);
    for (int s = n - 2; s >= 0; --s)
      for (int l = 0; l < lanes; ++l) {
        const int at = s * lanes + l;
        s_[at] += above_[at] * s_[at + lanes];
        end_[at] += above_[at] * end_[at + lanes];
      }
    if (!system.periodic) return;
    const int last = (n - 1) * lanes;
    double factor[lanes];
    for (int l = 0; l < lanes; ++l)
      factor[l] = (s_[l] + below_[l] * s_[last + l]) / (1 - (end_[l] + below_[l] * end_[last + l]));
    for (int s = 0; s < n; ++s)
      for (int l = 0; l < lanes; ++l) s_[s * lanes + l] += factor[l] * end_[s * lanes + l];
  }

 private:
  /// Forward elimination, and the last unknown; above_ becomes the factor of the next unknown.
  void eliminate(const LineSystem& system) {
    const int n = system.samples;
    for (int s = 0; s < n; ++s)
      for (int l = 0; l < lanes; ++l) {
        const int at = s * lanes + l;
        const bool first = s == 0, last = s == n - 1;
        double diagonal = 1 + below_[at] + above_[at], source = s_[at], column = 0;
        if (first && system.periodic) {
          diagonal += 1;
          column = 1;
        } else if (first) {
          diagonal -= below_[at] * system.lower.factor;
          source += below_[at] * system.lower.offset;
        } else {
          diagonal -= below_[at] * above_[at - lanes];
          source += below_[at] * s_[at - lanes];
          column = below_[at] * end_[at - lanes];
        }
        if (last && system.periodic) {
          diagonal += below_[l] * above_[at];
          column += above_[at];
        } else if (last) {
          diagonal -= above_[at] * system.upper.factor;
          source += above_[at] * system.upper.offset;
        }
        const double inverse = 1 / diagonal;
        s_[at] = source * inverse;
        end_[at] = column * inverse;
        above_[at] *= inverse;
      }
  }

  std::vector<double> s_, below_, above_, end_;
  int lines_ = 0;
};

void solveLines(const LineSystem& system) {
  const int across = system.axis == 0 ? 1 : 0, outer = 3 - system.axis - across;
  const Vec3i size = system.values.size;
  const int tiles = (size[across] + lanes - 1) / lanes;
  parallelFor(0, static_cast<std::int64_t>(size[outer]) * tiles, 4, [&](std::int64_t first, std::int64_t last) {
    LineTile tile(system.samples);
    for (std::int64_t n = first; n < last; ++n) {
      Vec3i place;
      place[outer] = static_cast<int>(n / tiles);
      place[across] = static_cast<int>(n % tiles) * lanes;
      runWide([&] {
        tile.load(system, place, across, std::min(lanes, size[across] - place[across]));
        if (system.coupling <= explicitLimit)
          tile.explicitStep(system);
        else
          tile.implicitStep(system);
        tile.store(system, place, across);
      });
    }
  });
}

/// Beyond a face of the box, for the velocity component along `component`.
LineEnd speedBeyond(const FluidSettings& settings, int face, int component) {
  if (settings.faces[face] != FaceKind::noSlip || face / 2 == component) return {1, 0};
  return {-1, 2 * settings.wallVelocity[face][component]};
}
}  // namespace

void diffuseVelocity(FluidState& gas, const FluidSettings& settings, double dt) {
  const double coupling = settings.viscosity * dt / (settings.cellSize * settings.cellSize);
  for (int component = 0; component < 3; ++component)
    for (int axis = 0; axis < 3; ++axis) {
      Grid3<float>& speed = gas.velocity.component(component);
      const bool periodic = isPeriodic(settings.faces, axis);
      const int samples = speed.size[axis] - (periodic && axis == component ? 1 : 0);
      solveLines({speed, gas.solid.openShare.component(component), false, axis, coupling,
                  speedBeyond(settings, 2 * axis, component), speedBeyond(settings, 2 * axis + 1, component), samples,
                  periodic});
    }
}

void conduct(FluidState& gas, const FluidSettings& settings, double dt) {
  const double coupling = settings.conductivity * dt / (settings.cellSize * settings.cellSize);
  for (int axis = 0; axis < 3; ++axis)
    solveLines({gas.temperature, gas.solid.openShare.component(axis), true, axis, coupling, LineEnd{}, LineEnd{},
                gas.temperature.size[axis], isPeriodic(settings.faces, axis)});
}

}  // namespace brisance
