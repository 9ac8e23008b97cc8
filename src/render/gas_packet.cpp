// Sixteen ways through the gas side by side, one in each lane of vectors.
#include "base/vector_path.h"
#include "render/gas_samples.h"
#include "render/gas_steps.h"

namespace brisance {

namespace {
constexpr int lanes = GasMedium::packet;
static_assert(lanes == packetLanes);
}  // namespace

/// The ways, and what has come of them so far.
struct GasWays {
  FloatLanes start[3], slope[3], perSlope[3];  ///< [cells], [cells/m], [m/cell]
  FloatLanes near, far;                        ///< [m] where the way is in the gas
  FloatLanes begin, behind;                    ///< [m] where step 0 begins and ends
  FloatLanes number, end;                      ///< of the next step, and of the one after the way's last
  FloatLanes transmittance;
  alignas(64) GasSample light[lanes];

  bool goOn() const {
    std::int32_t any = 0;
    for (int n = 0; n < lanes; ++n) any |= (number[n] < end[n]) & (transmittance[n] > 0);
    return any != 0;
  }
};

/// One step of each way. Ways that have ended go on in steps of length 0, which change nothing.
struct GasWaySteps {
  FloatLanes length;    ///< [m]
  WholeLanes block[3];  ///< in which its middle lies
  WholeLanes brick;     ///< -1 where there is none
  PacketSamples gas;    ///< there
};

/// As steps are numbered in alongSteps(). Lanes without a way have ended.
inline void GasMedium::enter(std::span<const GasPath> paths, GasWays& ways) const {
  constexpr float level = 1e-20f;  // a slope that is none, but has an inverse
  const float perCell = 1 / cellSize_, perStep = 1 / step_;
  for (int n = 0; n < lanes; ++n) {
    const GasPath& path = paths[std::min<std::size_t>(n, paths.size() - 1)];
    for (int axis = 0; axis < 3; ++axis) {
      ways.start[axis][n] = (path.origin[axis] - origin_[axis]) * perCell;
      ways.slope[axis][n] = path.direction[axis] * perCell;
    }
    ways.near[n] = path.near;
    ways.far[n] = path.far;
    ways.begin[n] = (path.phase - 1) * step_;
    ways.behind[n] = path.phase * step_;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const float lower = (lower_[axis] - origin_[axis]) * perCell, upper = (upper_[axis] - origin_[axis]) * perCell;
    for (int n = 0; n < lanes; ++n) {
      const float slope = std::abs(ways.slope[axis][n]) < level ? level : ways.slope[axis][n];
      ways.slope[axis][n] = slope;
      const float perSlope = 1 / slope;
      ways.perSlope[axis][n] = perSlope;
      const float a = (lower - ways.start[axis][n]) * perSlope, b = (upper - ways.start[axis][n]) * perSlope;
      ways.near[n] = std::max(std::min(a, b), ways.near[n]);
      ways.far[n] = std::min(std::max(a, b), ways.far[n]);
    }
  }
  for (int n = 0; n < lanes; ++n) {
    const bool crosses = (ways.near[n] < ways.far[n]) & (n < static_cast<int>(paths.size()));
    const float first = std::floor((ways.near[n] - ways.behind[n]) * perStep) + 1,
                end = std::ceil((ways.far[n] - ways.behind[n]) * perStep) + 1;
    ways.number[n] = crosses ? first : 0;
    ways.end[n] = crosses ? end : 0;
    ways.far[n] = crosses ? ways.far[n] : 0;
    ways.near[n] = crosses ? ways.near[n] : 0;
    ways.transmittance[n] = 1;
    ways.light[n] = {};
  }
}

inline void GasMedium::look(const GasWays& ways, GasWaySteps& steps) const {
  FloatLanes middle;
  WholeLanes cell[3], block;
  for (int n = 0; n < lanes; ++n) {
    const float from = std::max(ways.number[n] * step_ + ways.begin[n], ways.near[n]),
                to = std::min(ways.number[n] * step_ + ways.behind[n], ways.far[n]);
    steps.length[n] = std::max(to - from, 0.0f);
    middle[n] = 0.5f * (from + to);
  }
  const Vec3i blocks = blockLargest_.size;
  for (int axis = 0; axis < 3; ++axis) {
    const float upper = static_cast<float>(blocks[axis] * blockCells) - 1e-3f;
    for (int n = 0; n < lanes; ++n) {
      const float place = ways.start[axis][n] + ways.slope[axis][n] * middle[n];
      const float inside = std::min(std::max(place, 0.0f), upper);
      const auto whole = static_cast<std::int32_t>(inside);
      steps.block[axis][n] = whole >> blockBits;
      cell[axis][n] = whole & (blockCells - 1);
      steps.gas.share[axis][n] = inside - static_cast<float>(whole);
    }
  }
  for (int n = 0; n < lanes; ++n)
    block[n] = steps.block[0][n] + blocks.x * (steps.block[1][n] + blocks.y * steps.block[2][n]);
  for (int n = 0; n < lanes; ++n) steps.brick[n] = brickOf_[block[n]];
  for (int n = 0; n < lanes; ++n)
    steps.gas.first[n] =
        GasBrick::samplesBefore(std::max(steps.brick[n], 0)) + GasBrick::index(cell[0][n], cell[1][n], cell[2][n]);
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
      const auto face = static_cast<float>((steps.block[axis][n] + (ways.slope[axis][n] > 0 ? 1 : 0)) * blockCells);
      leaves = std::min(leaves, (face - ways.start[axis][n]) * ways.perSlope[axis][n]);
    }
    const float next = ways.number[n] + 1, beyond = std::ceil((leaves - ways.behind[n]) * perStep + 0.5f);
    ways.number[n] = steps.brick[n] < 0 ? std::max(next, beyond) : next;
  }
}

/// Adds to the light of each lane what its sample gives times a weight, four lanes at a time.
inline void addWeighed(const GasSample* samples, const FloatLanes& weight, GasSample* light) {
  using Four [[gnu::vector_size(64)]] = float;
  for (int n = 0; n < lanes; n += 4) {
    const float a = weight[n], b = weight[n + 1], c = weight[n + 2], d = weight[n + 3];
    const Four weights{a, a, a, a, b, b, b, b, c, c, c, c, d, d, d, d};
    *reinterpret_cast<Four*>(light + n) += *reinterpret_cast<const Four*>(samples + n) * weights;
  }
}

/// Equations A.3 and A.4.
inline void GasMedium::shine(const GasWaySteps& steps, GasWays& ways) const {
  constexpr float least = 1e-30f;  // divides nothing by something
  FloatLanes weight;
  for (int n = 0; n < lanes; ++n) {
    const float density = steps.brick[n] < 0 ? 0 : steps.gas.density[n] * GasCode::unit;
    const float passing = fastExp(-optics_.extinction(density) * steps.length[n]);
    weight[n] = (1 - passing) / std::max(density, least) * ways.transmittance[n] * GasCode::unit;
    const float left = ways.transmittance[n] * passing;
    ways.transmittance[n] = left < seeThrough ? 0 : left;
  }
  addWeighed(steps.gas.sample, weight, ways.light);
}

template <class Read>
void GasMedium::marchPacket(std::span<const GasPath> paths, std::span<GasPassage> passages) const {
  GasWays ways;
  GasWaySteps steps;
  enter(paths, ways);
  while (ways.goOn()) {
    look(ways, steps);
    std::int32_t any = -1;
    for (int n = 0; n < lanes; ++n) any = std::max(any, steps.brick[n]);
    if (any >= 0) {
      Read::read(memory_.bricks.get(), steps.gas);
      shine(steps, ways);
    }
    pass(steps, ways);
  }
  for (int n = 0; n < static_cast<int>(paths.size()); ++n)
    passages[n] = {{ways.light[n].values[0], ways.light[n].values[1], ways.light[n].values[2]}, ways.transmittance[n]};
}

template <class Read>
void GasMedium::marchPackets(std::span<const GasPath> paths, std::span<GasPassage> passages) const {
  for (std::size_t n = 0; n < paths.size(); n += packet) {
    const std::size_t count = std::min<std::size_t>(packet, paths.size() - n);
    marchPacket<Read>(paths.subspan(n, count), passages.subspan(n, count));
  }
}

void GasMedium::march(std::span<const GasPath> paths, std::span<GasPassage> passages) const {
  if (vectorPath() == VectorPath::avx512)
    detail::runAvx512([&] { marchPackets<ReadFours>(paths, passages); });
  else
    runWide([&] { marchPackets<ReadEach>(paths, passages); });
}

}  // namespace brisance
