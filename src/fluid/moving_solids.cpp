#include "fluid/moving_solids.h"

#include <algorithm>

#include "base/parallel.h"

namespace brisance {

namespace {
/// What a body carries through its part of a face, per face [m/s].
double carriedBy(const SolidStamp& solid, const BodyFace& f, const MacVelocity& velocity) {
  const Vec3d place = velocity.component(f.axis).position(f.face.x, f.face.y, f.face.z);
  return f.share * solid.bodies[f.body].velocityAt(place)[f.axis];
}

/// Calls change(speed, share) for the faces of rows in which not all are open.
template <class Change>
void forCutRows(FluidState& gas, const Change& change) {
  const Vec3i n = gas.solid.inside.size;
  const auto row = [&](int axis, int j, int k) {
    float* speed = &gas.velocity.component(axis)(0, j, k);
    const float* share = &gas.solid.openShare.component(axis)(0, j, k);
    for (int i = 0; i < n.x + (axis == 0); ++i) change(speed[i], share[i]);
  };
  parallelFor(0, n.z, 1, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < n.y; ++j) {
        if (!gas.solid.cutRows[j + static_cast<std::size_t>(n.y) * k]) continue;
        for (int axis = 0; axis < 3; ++axis) row(axis, j, k);
        if (j + 1 == n.y) row(1, n.y, k);
        if (k + 1 == n.z) row(2, j, n.z);
      }
  });
}

/// Velocity of the gas in the open part of a face.
double gasSpeed(const FluidState& gas, int axis, std::int64_t index) {
  double speed = gas.velocity.component(axis).values[index];
  const auto& faces = gas.solid.bodyFaces;
  auto f = std::partition_point(faces.begin(), faces.end(), [&](const BodyFace& face) {
    return face.axis != axis ? face.axis < axis : face.index < index;
  });
  for (; f != faces.end() && f->axis == axis && f->index == index; ++f) speed -= carriedBy(gas.solid, *f, gas.velocity);
  return speed / gas.solid.openShare.component(axis).values[index];
}

/// Fields at cell centres that a cell needs when gas comes into it.
std::array<Grid3<float>*, 4> cellFields(FluidState& gas) {
  return {&gas.temperature, &gas.soot, &gas.flame, &gas.pressure};
}

/// Cells that were solid take the mean of their neighbours that hold gas, those nearest to such gas first.
class Uncovering {
 public:
  Uncovering(FluidState& gas, const FluidSettings& settings, Grid3<std::uint8_t> solidBefore)
      : gas_(gas), settings_(settings), unknown_(std::move(solidBefore)) {}

  void fill() {
    std::vector<Vec3i> cells = uncovered();
    while (!cells.empty()) {
      std::vector<Vec3i> left, known;
      for (const Vec3i& cell : cells) (takeMean(cell) ? known : left).push_back(cell);
      for (const Vec3i& cell : known) unknown_(cell.x, cell.y, cell.z) = 0;
      if (known.empty()) break;
      cells = std::move(left);
    }
    for (const Vec3i& cell : cells) setAmbient(cell);
  }

 private:
  std::vector<Vec3i> uncovered() const {
    std::vector<Vec3i> cells;
    const Vec3i n = unknown_.size;
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i)
          if (unknown_(i, j, k) && !gas_.solid.inside(i, j, k)) cells.push_back({i, j, k});
    return cells;
  }

  bool takeMean(const Vec3i& cell) {
    double sums[4] = {}, count = 0;
    const auto fields = cellFields(gas_);
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        Vec3i next = cell;
        next[axis] += side;
        if (!unknown_.contains(next.x, next.y, next.z) || unknown_(next.x, next.y, next.z)) continue;
        if (gas_.solid.inside(next.x, next.y, next.z)) continue;
        for (int n = 0; n < 4; ++n) sums[n] += (*fields[n])(next.x, next.y, next.z);
        ++count;
      }
    if (count == 0) return false;
    for (int n = 0; n < 4; ++n) (*fields[n])(cell.x, cell.y, cell.z) = static_cast<float>(sums[n] / count);
    return true;
  }

  void setAmbient(const Vec3i& cell) {
    for (Grid3<float>* field : cellFields(gas_)) (*field)(cell.x, cell.y, cell.z) = 0;
    gas_.temperature(cell.x, cell.y, cell.z) = static_cast<float>(settings_.ambientTemperature);
  }

  FluidState& gas_;
  const FluidSettings& settings_;
  Grid3<std::uint8_t> unknown_;
};
}  // namespace

void takeGasVelocity(FluidState& gas) {
  for (const BodyFace& f : gas.solid.bodyFaces) {
    if (gas.solid.openShare.component(f.axis).values[f.index] == 0) continue;
    float& speed = gas.velocity.component(f.axis).values[f.index];
    speed = static_cast<float>(speed - carriedBy(gas.solid, f, gas.velocity));
  }
  forCutRows(gas, [](float& speed, float share) {
    if (share > 0) speed /= share;
  });
}

void takeMeanVelocity(FluidState& gas) {
  forCutRows(gas, [](float& speed, float share) { speed *= share; });
  for (const BodyFace& f : gas.solid.bodyFaces) {
    float& speed = gas.velocity.component(f.axis).values[f.index];
    speed = static_cast<float>(speed + carriedBy(gas.solid, f, gas.velocity));
  }
}

double fastestGas(const FluidState& gas, int axis, double fastestMean) {
  const Vec3i n = gas.solid.inside.size;
  const Grid3<float>&mean = gas.velocity.component(axis), &open = gas.solid.openShare.component(axis);
  for (const BodyFace& f : gas.solid.bodyFaces)
    if (f.axis == axis && open.values[f.index] > 0)
      fastestMean = std::max(fastestMean, std::abs(gasSpeed(gas, axis, f.index)));
  return parallelMax(n.z, 1, [&](std::int64_t first, std::int64_t last) {
    double fastest = fastestMean;
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < n.y; ++j) {
        if (!gas.solid.cutRows[j + static_cast<std::size_t>(n.y) * k]) continue;
        for (std::int64_t at = mean.index(0, j, k), end = at + mean.size.x; at < end; ++at) {
          const float share = open.values[at];
          if (share == 0 || share == 1 || std::abs(mean.values[at]) <= share * fastest) continue;
          fastest = std::max(fastest, std::abs(gasSpeed(gas, axis, at)));
        }
      }
    return fastest;
  });
}

void moveSolids(FluidState& gas, std::span<const MovingSolid> bodies, const FluidSettings& settings,
                SolidStamper& stamper) {
  takeGasVelocity(gas);
  Grid3<std::uint8_t> solidBefore = gas.solid.inside;
  stamper.stampMoving(bodies, gas.solid);
  Uncovering(gas, settings, std::move(solidBefore)).fill();
  takeMeanVelocity(gas);
}

}  // namespace brisance
