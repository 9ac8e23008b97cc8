#include "frame/splat_rows.h"

#include <algorithm>

#include "base/vector_path.h"

namespace brisance {

namespace {

constexpr int vectorFloats = 16;  // the widest vectors hold as many
constexpr int blockCells = 32;    // cells along x whose sums stay in registers
constexpr int channels = 4;       // mass, and mass times red, green, blue

constexpr int roundUp(int count, int unit) { return (count + unit - 1) / unit * unit; }

}  // namespace

GaussianFilter::GaussianFilter(double deviation, int radius)
    : radius_(deviation > 0 ? radius : 0),
      spread_(roundUp(2 * radius_ + 2, vectorFloats)),
      centre_(radius_ + 1),
      weights_(centre_ + radius_ + 1 + spread_, 0.f) {
  std::vector<double> exact;
  double sum = 0;
  for (int t = -radius_; t <= radius_; ++t) {
    exact.push_back(radius_ > 0 ? portableExp(-0.5 * t * t / (deviation * deviation)) : 1);
    sum += exact.back();
  }
  for (std::size_t n = 0; n < exact.size(); ++n) weights_[n + 1] = static_cast<float>(exact[n] / sum);
}

std::vector<float> GaussianFilter::gainInside(int count) const {
  std::vector<float> gain(count);
  for (int cell = 0; cell < count; ++cell) {
    double inside = 0;
    for (int t = std::max(-radius_, -cell); t <= std::min(radius_, count - 1 - cell); ++t) inside += (*this)(t);
    gain[cell] = static_cast<float>(1 / inside);
  }
  return gain;
}

namespace {

/// What one row of the volume along y holds before it is blurred along z: for each slab k, and `radius` empty ones
/// around them, four channels of cells along x.
class RowPlane {
 public:
  RowPlane(const Vec3i& size, const GaussianFilter& filter)
      : slabs_(size.z),
        radius_(filter.radius()),
        width_(roundUp(size.x, blockCells) + filter.spread()),
        blocks_(roundUp(width_, blockCells) / blockCells),
        values_(static_cast<std::size_t>(slabStride()) * (slabs_ + 2 * radius_), 0.f),
        used_(static_cast<std::size_t>(blocks_) * slabs_, 0) {}

  int width() const { return width_; }
  std::int64_t slabStride() const { return static_cast<std::int64_t>(channels) * width_; }
  float* slab(int k) { return values_.data() + slabStride() * (k + radius_); }
  const float* slab(int k) const { return values_.data() + slabStride() * (k + radius_); }
  bool isUsed(int k, int block) const {
    return k >= 0 && k < slabs_ && used_[block + static_cast<std::size_t>(blocks_) * k];
  }

  void markUsed(int k, int firstCell, int endCell) {
    for (int block = firstCell / blockCells; block * blockCells < endCell; ++block)
      used_[block + static_cast<std::size_t>(blocks_) * k] = 1;
  }

  /// Empties the slabs that were used.
  void clear() {
    for (int k = 0; k < slabs_; ++k) {
      const auto first = used_.begin() + static_cast<std::int64_t>(blocks_) * k;
      if (std::find(first, first + blocks_, 1) == first + blocks_) continue;
      std::fill(first, first + blocks_, std::uint8_t{0});
      std::fill_n(slab(k), slabStride(), 0.f);
    }
  }

 private:
  int slabs_, radius_, width_, blocks_;
  std::vector<float> values_;
  std::vector<std::uint8_t> used_;
};

/// Weight of a splat at `cell` along an axis, blurred.
inline float blurredShare(const AxisShare& share, const GaussianFilter& filter, int cell) {
  return share.lowerWeight * filter(cell - share.lower) + share.upperWeight * filter(cell - share.upper);
}

/// Adds a splat's blurred profile along x, times `weight`, to one slab.
inline void addProfile(const Splat& splat, const float* profile, int spread, float weight, float* cells, int width) {
  for (int c = 0; c < channels; ++c, cells += width) {
    const float amount = splat.amount[c] * weight;
    for (int n = 0; n < spread; n += vectorFloats)
      for (int lane = 0; lane < vectorFloats; ++lane) cells[n + lane] += amount * profile[n + lane];
  }
}

/// Adds one splat to row j.
inline void addSplat(const Splat& splat, const GaussianFilter& filter, int j, float* profile, RowPlane& plane) {
  const auto& [x, y, z] = splat.share;
  const float weight = blurredShare(y, filter, j);
  const int first = std::max(0, x.lower - filter.radius()), spread = filter.spread();
  const float *lower = filter.at(first - x.lower), *upper = filter.at(first - x.upper);
  for (int n = 0; n < spread; ++n) profile[n] = x.lowerWeight * lower[n] + x.upperWeight * upper[n];
  addProfile(splat, profile, spread, weight * z.lowerWeight, plane.slab(z.lower) + first, plane.width());
  addProfile(splat, profile, spread, weight * z.upperWeight, plane.slab(z.upper) + first, plane.width());
  plane.markUsed(z.lower, first, first + spread);
  plane.markUsed(z.upper, first, first + spread);
}

/// Sums of the filter along z over `blockCells` cells; `cells` points into the middle slab.
inline void blurBlock(const float* cells, std::int64_t slabStride, const GaussianFilter& filter, float* sums) {
  float sum[blockCells];
  const float middle = filter(0);
  for (int n = 0; n < blockCells; ++n) sum[n] = middle * cells[n];
#pragma GCC unroll 1  // unrolled, the sums would move to the stack
  for (int t = 1; t <= filter.radius(); ++t) {
    const float weight = filter(t), *below = cells - t * slabStride, *above = cells + t * slabStride;
    for (int n = 0; n < blockCells; ++n) sum[n] += weight * (below[n] + above[n]);
  }
  for (int n = 0; n < blockCells; ++n) sums[n] = sum[n];
}

/// Blurs row j of `plane` along z into the volume: one block of cells along x.
struct RowBlur {
  const RowPlane& plane;
  const GaussianFilter& filter;
  int row;
  ParticleVolume& volume;

  void block(int number) const {
    const int slabs = volume.density.size.z, radius = filter.radius();
    int usedInWindow = 0;
    for (int k = 0; k < radius; ++k) usedInWindow += plane.isUsed(k, number);
    for (int k = 0; k < slabs; ++k) {
      usedInWindow += plane.isUsed(k + radius, number);
      usedInWindow > 0 ? writeBlurred(number, k) : writeEmpty(number, k);
      usedInWindow -= plane.isUsed(k - radius, number);
    }
  }

 private:
  int cellsIn(int number) const { return std::min(blockCells, volume.density.size.x - number * blockCells); }

  void writeEmpty(int number, int k) const {
    const std::int64_t at = volume.density.index(number * blockCells, row, k);
    std::fill_n(volume.density.values.begin() + at, cellsIn(number), 0.f);
    std::fill_n(volume.colour.values.begin() + at, cellsIn(number), Vec3f());
  }

  void writeBlurred(int number, int k) const {
    alignas(64) float sums[channels][blockCells];
    for (int c = 0; c < channels; ++c)
      blurBlock(plane.slab(k) + c * plane.width() + number * blockCells, plane.slabStride(), filter, sums[c]);
    const double cell = volume.density.cellSize;
    const float perVolume = static_cast<float>(1 / (cell * cell * cell));
    const std::int64_t at = volume.density.index(number * blockCells, row, k);
    float* density = volume.density.values.data() + at;
    Vec3f* colour = volume.colour.values.data() + at;
    alignas(64) float perMass[blockCells];
    for (int n = 0; n < blockCells; ++n) perMass[n] = sums[0][n] > 0 ? 1 / sums[0][n] : 0;
    const int cells = cellsIn(number);
    for (int n = 0; n < cells; ++n) density[n] = sums[0][n] * perVolume;
    for (int n = 0; n < cells; ++n)
      colour[n] = {sums[1][n] * perMass[n], sums[2][n] * perMass[n], sums[3][n] * perMass[n]};
  }
};

}  // namespace

void fillRows(const SortedSplats& sorted, const GaussianFilter& filter, int firstRow, int lastRow,
              ParticleVolume& volume) {
  const Vec3i size = volume.density.size;
  RowPlane plane(size, filter);
  std::vector<float> profile(filter.spread());
  for (int j = firstRow; j < lastRow; ++j) {
    // A splat whose lower cell is `lower` reaches from lower - radius to lower + 1 + radius.
    const auto first = sorted.rowStart[std::max(0, j - filter.radius() - 1)];
    const auto last = sorted.rowStart[std::min(size.y, j + filter.radius() + 1)];
    runWide([&] {
      for (auto n = first; n < last; ++n) addSplat(sorted.splats[n], filter, j, profile.data(), plane);
      const RowBlur blur{plane, filter, j, volume};
      for (int number = 0; number * blockCells < size.x; ++number) blur.block(number);
    });
    plane.clear();
  }
}

}  // namespace brisance
