// Sixteen ways through the gas side by side, one in each lane of vectors.
#include "base/vector_path.h"
#include "render/gas_steps.h"

namespace brisance {

namespace {

constexpr int lanes = GasMedium::packet;

template <class T>
struct alignas(64) PacketLanes {
  T value[lanes];
  T& operator[](int n) { return value[n]; }
  const T& operator[](int n) const { return value[n]; }
};
using Floats = PacketLanes<float>;
using Whole = PacketLanes<std::int32_t>;

}  // namespace

/// The ways, and what has come of them so far.
struct GasWays {
  Floats start[3], slope[3], perSlope[3];  ///< [cells], [cells/m], [m/cell]
  Floats near, far;                        ///< [m] where the way is in the gas
  Floats phase, number, end;               ///< of the next step, and of the one after the way's last
  Floats transmittance;
  alignas(64) GasSample light[lanes];

  bool goOn() const {
    std::int32_t any = 0;
    for (int n = 0; n < lanes; ++n) any |= number[n] < end[n];
    return any != 0;
  }
};

/// One step of each way.
struct GasWaySteps {
  Floats length;                        ///< [m]
  Floats place[3];                      ///< [cells] of its middle
  Whole block[3];                       ///< in which that lies
  Whole brick;                          ///< -1 where there is none, or the way has ended
  alignas(64) GasSample sample[lanes];  ///< of the gas there
};

/// As steps are numbered in alongSteps(). Lanes without a way have ended.
inline void GasMedium::enter(std::span<const GasPath> paths, GasWays& ways) const {
  const float perCell = 1 / cellSize_, perStep = 1 / step_;
  for (int n = 0; n < lanes; ++n) {
    const GasPath& path = paths[std::min<std::size_t>(n, paths.size() - 1)];
    for (int axis = 0; axis < 3; ++axis) {
      ways.start[axis][n] = (path.origin[axis] - origin_[axis]) * perCell;
      ways.slope[axis][n] = path.direction[axis] * perCell;
    }
    ways.near[n] = path.near;
    ways.far[n] = path.far;
    ways.phase[n] = path.phase;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const float lower = (lower_[axis] - origin_[axis]) * perCell, upper = (upper_[axis] - origin_[axis]) * perCell;
    for (int n = 0; n < lanes; ++n) {
      const float slope = ways.slope[axis][n], perSlope = 1 / slope;
      ways.perSlope[axis][n] = perSlope;
      const float a = (lower - ways.start[axis][n]) * perSlope, b = (upper - ways.start[axis][n]) * perSlope;
      const float enter = a < b ? a : b, leave = a < b ? b : a;
      ways.near[n] = enter > ways.near[n] ? enter : ways.near[n];
      ways.far[n] = leave < ways.far[n] ? leave : ways.far[n];
    }
  }
  for (int n = 0; n < lanes; ++n) {
    const bool crosses = (ways.near[n] < ways.far[n]) & (n < static_cast<int>(paths.size()));
    const float first = std::floor(ways.near[n] * perStep - ways.phase[n]) + 1,
                end = std::ceil(ways.far[n] * perStep - ways.phase[n]) + 1;
    ways.number[n] = crosses ? first : 0;
    ways.end[n] = crosses ? end : 0;
    ways.transmittance[n] = 1;
    ways.light[n] = {};
  }
}

inline void GasMedium::look(const GasWays& ways, GasWaySteps& steps) const {
  Floats middle;
  for (int n = 0; n < lanes; ++n) {
    const float from = std::max((ways.number[n] - 1 + ways.phase[n]) * step_, ways.near[n]),
                to = std::min((ways.number[n] + ways.phase[n]) * step_, ways.far[n]);
    steps.length[n] = to - from;
    middle[n] = 0.5f * (from + to);
  }
  const Vec3i blocks = blockLargest_.size;
  for (int axis = 0; axis < 3; ++axis) {
    const float upper = static_cast<float>(blocks[axis] * blockCells) - 1e-3f;
    for (int n = 0; n < lanes; ++n) {
      const float place = ways.start[axis][n] + ways.slope[axis][n] * middle[n];
      steps.place[axis][n] = std::min(std::max(place, 0.0f), upper);
      steps.block[axis][n] = static_cast<std::int32_t>(steps.place[axis][n]) / blockCells;
    }
  }
  for (int n = 0; n < lanes; ++n) {
    const std::int32_t brick =
        brickOf_[steps.block[0][n] + blocks.x * (steps.block[1][n] + blocks.y * steps.block[2][n])];
    steps.brick[n] = ways.number[n] < ways.end[n] ? brick : -1;
  }
}

/// To the next step: in gas the next one, else the first whose middle lies beyond the block.
inline void GasMedium::pass(const GasWaySteps& steps, GasWays& ways) const {
  std::int32_t least = 0;
  for (int n = 0; n < lanes; ++n) least = std::min(least, steps.brick[n]);
  if (least == 0) {
    for (int n = 0; n < lanes; ++n) ++ways.number[n];
    return;
  }
  const float perStep = 1 / step_;
  for (int n = 0; n < lanes; ++n) {
    float leaves = ways.far[n];
    for (int axis = 0; axis < 3; ++axis) {
      const float slope = ways.slope[axis][n];
      const auto face = static_cast<float>((steps.block[axis][n] + (slope > 0 ? 1 : 0)) * blockCells);
      const float distance = (face - ways.start[axis][n]) * ways.perSlope[axis][n];
      leaves = (slope != 0) & (distance < leaves) ? distance : leaves;
    }
    const float next = ways.number[n] + 1, beyond = std::ceil(leaves * perStep + 0.5f - ways.phase[n]);
    ways.number[n] = steps.brick[n] < 0 && beyond > next ? beyond : next;
  }
}

inline void GasMedium::read(GasWaySteps& steps) const {
  constexpr float inside = GasBrick::cells - 1e-5f;
  Floats share[3];
  Whole cell[3], first;
  for (int axis = 0; axis < 3; ++axis)
    for (int n = 0; n < lanes; ++n) {
      const float local =
          std::min(steps.place[axis][n] - static_cast<float>(steps.block[axis][n] * blockCells), inside);
      cell[axis][n] = static_cast<std::int32_t>(local);
      share[axis][n] = local - static_cast<float>(cell[axis][n]);
    }
  for (int n = 0; n < lanes; ++n) first[n] = GasBrick::index(cell[0][n], cell[1][n], cell[2][n]);
  for (int n = 0; n < lanes; ++n)
    steps.sample[n] =
        memory_.bricks[std::max(steps.brick[n], 0)].between(first[n], share[0][n], share[1][n], share[2][n]);
}

/// Adds to the light of each lane what its sample gives times a weight, four lanes at a time.
inline void addWeighed(const GasSample* samples, const Floats& weight, GasSample* light) {
  using Four [[gnu::vector_size(64)]] = float;
  for (int n = 0; n < lanes; n += 4) {
    const float a = weight[n], b = weight[n + 1], c = weight[n + 2], d = weight[n + 3];
    const Four weights{a, a, a, a, b, b, b, b, c, c, c, c, d, d, d, d};
    *reinterpret_cast<Four*>(light + n) += *reinterpret_cast<const Four*>(samples + n) * weights;
  }
}

/// Equations A.3 and A.4.
inline void GasMedium::shine(const GasWaySteps& steps, GasWays& ways) const {
  Floats density, weight;
  for (int n = 0; n < lanes; ++n) density[n] = steps.sample[n].density();
  for (int n = 0; n < lanes; ++n) {
    const float here = steps.brick[n] < 0 ? 0 : density[n];
    const float passing = fastExp(-optics_.extinction(here) * steps.length[n]);
    weight[n] = here > 0 ? (1 - passing) / here * ways.transmittance[n] : 0;
    const float left = ways.transmittance[n] * passing;
    ways.transmittance[n] = left < seeThrough ? 0 : left;
    ways.end[n] = left < seeThrough ? 0 : ways.end[n];
  }
  addWeighed(steps.sample, weight, ways.light);
}

inline void GasMedium::marchPacket(std::span<const GasPath> paths, std::span<GasPassage> passages) const {
  GasWays ways;
  GasWaySteps steps;
  enter(paths, ways);
  while (ways.goOn()) {
    look(ways, steps);
    std::int32_t any = -1;
    for (int n = 0; n < lanes; ++n) any = std::max(any, steps.brick[n]);
    if (any >= 0) {
      read(steps);
      shine(steps, ways);
    }
    pass(steps, ways);
  }
  for (int n = 0; n < static_cast<int>(paths.size()); ++n)
    passages[n] = {{ways.light[n].values[0], ways.light[n].values[1], ways.light[n].values[2]}, ways.transmittance[n]};
}

void GasMedium::march(std::span<const GasPath> paths, std::span<GasPassage> passages) const {
  runWide([&] {
    for (std::size_t n = 0; n < paths.size(); n += packet) {
      const std::size_t count = std::min<std::size_t>(packet, paths.size() - n);
      marchPacket(paths.subspan(n, count), passages.subspan(n, count));
    }
  });
}

}  // namespace brisance
