#include "render/gas_medium.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "render/gas_steps.h"

namespace brisance {
namespace {

/// The share of the density range over which min_d fades in.
constexpr float fadeInShare = 0.01f;
/// Samples one and a half deviations of the blur apart: the sum over samples of a Gaussian is then its integral to
/// 2 exp(-2 pi^2 / 1.5^2), 0.03 % (Poisson summation), and a pixel's ways, whose phases differ, share even that out.
constexpr double stepPerBlur = 1.5;

struct Corner {
  std::int64_t first;
  float share;
};

/// The last sample at or before a coordinate, and how far the place is from it to the next; the outermost samples hold
/// beyond.
Corner corner(float cells, int n) {
  const float inside = std::clamp(cells, 0.0f, static_cast<float>(n - 1));
  const int first = std::min(static_cast<int>(inside), std::max(0, n - 2));
  return {first, inside - static_cast<float>(first)};
}

/// A block grid's value between the centres of the blocks around a place given in cells.
template <class T>
T sampleBlocks(const Grid3<T>& blocks, const Vec3f& cells) {
  constexpr float perBlock = 1.0f / GasMedium::blockCells, centre = 0.5f * (GasMedium::blockCells - 1);
  const Corner x = corner((cells.x - centre) * perBlock, blocks.size.x),
               y = corner((cells.y - centre) * perBlock, blocks.size.y),
               z = corner((cells.z - centre) * perBlock, blocks.size.z);
  const std::int64_t right = blocks.size.x > 1, up = blocks.size.y > 1 ? blocks.stride(1) : 0,
                     back = blocks.size.z > 1 ? blocks.stride(2) : 0;
  const T* base = blocks.values.data() + x.first + blocks.stride(1) * y.first + blocks.stride(2) * z.first;
  const auto line = [&](const T* at) { return at[0] * (1 - x.share) + at[right] * x.share; };
  const auto plane = [&](const T* at) { return line(at) * (1 - y.share) + line(at + up) * y.share; };
  return plane(base) * (1 - z.share) + plane(base + back) * z.share;
}

Vec3i blocksOf(const Vec3i& cells) {
  constexpr int n = GasMedium::blockCells;
  return {(cells.x + n - 1) / n, (cells.y + n - 1) / n, (cells.z + n - 1) / n};
}

template <class T>
Grid3<T> blockGrid(const Grid3<float>& fine) {
  const double toCentre = 0.5 * (GasMedium::blockCells - 1) * fine.cellSize;
  return {blocksOf(fine.size), fine.origin + Vec3d(toCentre, toCentre, toCentre),
          GasMedium::blockCells * fine.cellSize};
}

/// Twice what is needed, since a growing cloud needs more in the next frame; pages that nobody touches cost nothing.
SampleMemory withRoomFor(std::int64_t count, SampleMemory memory) {
  if (memory.count >= count) return memory;
  memory = {};
  return {std::make_unique_for_overwrite<GasSample[]>(static_cast<std::size_t>(2 * count)), 2 * count};
}

}  // namespace

GasOptics::GasOptics(const VolumeSettings& settings)
    : opacity_(static_cast<float>(settings.opacity)),
      minDensity_(static_cast<float>(settings.minDensity)),
      densityRange_(static_cast<float>(settings.maxDensity - settings.minDensity)),
      fullDensity_(static_cast<float>(settings.fullDensity)),
      emission_(static_cast<float>(settings.emission)),
      smokeColour_(settings.smokeColour) {}

float GasOptics::extinction(float density) const {
  if (density <= 0) return 0;
  const float share = std::min(1.0f, density / fullDensity_);
  const float t = std::min(1.0f, share / fadeInShare);
  const float fade = t * t * (3 - 2 * t);
  return opacity_ * (minDensity_ * fade + densityRange_ * share);
}

GasMedium::GasMedium(const ParticleVolume& volume, const VolumeSettings& settings, SampleMemory memory)
    : size_(volume.density.size),
      cellSize_(static_cast<float>(volume.density.cellSize)),
      memory_(withRoomFor(volume.density.count(), std::move(memory))),
      optics_(settings),
      step_(static_cast<float>(std::max(volume.density.cellSize, stepPerBlur * settings.blur))),
      origin_(volume.density.origin),
      blockExtinction_(blockGrid<float>(volume.density)),
      blockLargest_(blockGrid<float>(volume.density)),
      blockGlow_(blockGrid<Vec3f>(volume.density)),
      blockScattered_(blockGrid<Vec3f>(volume.density)) {
  const Vec3i blocks = blockLargest_.size;
  parallelFor(0, static_cast<std::int64_t>(blocks.y) * blocks.z, 4, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t row = first; row < last; ++row)
      for (int i = 0; i < blocks.x; ++i)
        summariseBlock(volume, i, static_cast<int>(row % blocks.y), static_cast<int>(row / blocks.y));
  });
  pack(volume);
  boundOccupied();
}

/// A place between samples reads four short runs of memory instead of sixteen.
void GasMedium::pack(const ParticleVolume& volume) {
  constexpr std::int64_t cellsPerPiece = 1 << 16;
  parallelFor(0, volume.density.count(), cellsPerPiece, [&](std::int64_t first, std::int64_t last) {
    runWide([&] {
      for (std::int64_t cell = first; cell < last; ++cell) {
        const float density = volume.density.values[cell];
        const Vec3f light = optics_.glow(volume.colour.values[cell]) * density;
        memory_.samples[cell].values = GasSample::Vector{light.x, light.y, light.z, density};
      }
    });
  });
}

GasSample GasMedium::sampleAt(const Vec3f& cells) const {
  const Corner x = corner(cells.x, size_.x), y = corner(cells.y, size_.y), z = corner(cells.z, size_.z);
  const std::int64_t row = size_.x, layer = row * size_.y;
  const std::int64_t right = size_.x > 1, up = size_.y > 1 ? row : 0, back = size_.z > 1 ? layer : 0;
  const GasSample* base = memory_.samples.get() + x.first + row * y.first + layer * z.first;
  const auto line = [&](const GasSample* at) { return at[0].values + (at[right].values - at[0].values) * x.share; };
  const auto plane = [&](const GasSample* at) { return line(at) + (line(at + up) - line(at)) * y.share; };
  const GasSample::Vector near = plane(base), far = plane(base + back);
  return {near + (far - near) * z.share};
}

void GasMedium::summariseBlock(const ParticleVolume& volume, int i, int j, int k) {
  const Grid3<float>& density = volume.density;
  const Vec3i lower{i * blockCells, j * blockCells, k * blockCells};
  const auto end = [&](int axis, int rim) { return std::min(lower[axis] + blockCells + rim, density.size[axis]); };
  // Places between the samples of this block read one sample more on each upper side.
  float largest = 0;
  for (int z = lower.z; z < end(2, 1); ++z)
    for (int y = lower.y; y < end(1, 1); ++y) {
      const float* row = &density(lower.x, y, z);
      for (int x = 0; x < end(0, 1) - lower.x; ++x) largest = std::max(largest, row[x]);
    }
  blockLargest_(i, j, k) = largest;
  if (largest <= 0) return;
  float extinction = 0;
  Vec3f glow;
  for (int z = lower.z; z < end(2, 0); ++z)
    for (int y = lower.y; y < end(1, 0); ++y)
      for (int x = lower.x; x < end(0, 0); ++x) {
        const float kappa = optics_.extinction(density(x, y, z));
        extinction += kappa;
        glow += optics_.glow(volume.colour(x, y, z)) * kappa;
      }
  const int cells = (end(0, 0) - lower.x) * (end(1, 0) - lower.y) * (end(2, 0) - lower.z);
  blockExtinction_(i, j, k) = extinction / static_cast<float>(cells);
  blockGlow_(i, j, k) = glow * static_cast<float>(density.cellSize * density.cellSize * density.cellSize);
}

void GasMedium::boundOccupied() {
  Box3 box;  // [cells], from the first sample: a block ends where the next one's samples begin
  for (int k = 0; k < blockLargest_.size.z; ++k)
    for (int j = 0; j < blockLargest_.size.y; ++j)
      for (int i = 0; i < blockLargest_.size.x; ++i) {
        if (blockLargest_(i, j, k) <= 0) continue;
        box.include(Vec3d(i, j, k) * blockCells);
        box.include(Vec3d(i + 1, j + 1, k + 1) * blockCells);
      }
  lower_ = upper_ = origin_;
  if (box.lower.x > box.upper.x) return;  // no gas at all
  // The volume's outermost cells reach half a cell beyond their samples.
  const Vec3f half(0.5f, 0.5f, 0.5f);
  lower_ = origin_ + (Vec3f(box.lower) - half) * cellSize_;
  upper_ = origin_ + min(Vec3f(box.upper), Vec3f(size_) - half) * cellSize_;
}

/// Cuts the path to the box of the occupied blocks; false when nothing is left.
bool GasMedium::clip(GasPath& path) const {
  for (int axis = 0; axis < 3; ++axis) {
    const float slope = 1 / path.direction[axis];
    float enter = (lower_[axis] - path.origin[axis]) * slope, leave = (upper_[axis] - path.origin[axis]) * slope;
    if (enter > leave) std::swap(enter, leave);
    // Written so that not-a-number (a ray within the box's face) changes nothing.
    if (enter > path.near) path.near = enter;
    if (leave < path.far) path.far = leave;
  }
  return path.near < path.far;
}

/// Equations A.3 and A.4 for one step of a length [m] around a place [cells].
void GasMedium::addStep(const Vec3f& place, float stepLength, GasPassage& passage) const {
  const GasSample sample = sampleAt(place);
  if (sample.density() <= 0) return;
  const float passing = fastExp(-optics_.extinction(sample.density()) * stepLength);
  passage.light += sample.light() * ((1 - passing) * passage.transmittance);
  passage.transmittance *= passing;
  if (passage.transmittance < seeThrough) passage.transmittance = 0;
}

void GasMedium::bakeScattered() {
  parallelFor(0, size_.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < size_.y; ++j) runWide([&] { bakeRow(j, k); });
  });
}

void GasMedium::bakeRow(int j, int k) {
  for (int i = 0; i < size_.x; ++i) {
    if (blockLargest_(i / blockCells, j / blockCells, k / blockCells) <= 0) {
      i += blockCells - 1 - i % blockCells;
      continue;
    }
    GasSample& sample = memory_.samples[i + size_.x * (j + static_cast<std::int64_t>(size_.y) * k)];
    if (sample.density() <= 0) continue;
    const Vec3f light = sampleBlocks(blockScattered_, Vec3f(Vec3i(i, j, k))) * sample.density();
    sample.values += GasSample::Vector{light.x, light.y, light.z, 0};
  }
}

GasPassage GasMedium::march(const GasPath& path) const {
  GasPassage passage;
  runWide([&] { passage = marchHere(path); });
  return passage;
}

GasPassage GasMedium::marchHere(const GasPath& path) const {
  GasPassage passage;
  alongSteps(path, [&](const GasStep& step) {
    addStep(step.place, step.to - step.from, passage);
    return passage.transmittance > 0;
  });
  return passage;
}

float GasMedium::roughTransmittance(const GasPath& path) const {
  float transmittance = 1;
  runWide([&] { transmittance = roughTransmittanceHere(path); });
  return transmittance;
}

float GasMedium::roughTransmittanceHere(GasPath path) const {
  if (!clip(path)) return 1;
  const auto block = static_cast<float>(blockExtinction_.cellSize);
  const int steps = static_cast<int>(std::ceil((path.far - path.near) / block));
  const float step = (path.far - path.near) / static_cast<float>(steps), perCell = 1 / cellSize_;
  const Vec3f start = (path.origin + path.direction * (path.near + 0.5f * step) - origin_) * perCell,
              stride = path.direction * (step * perCell);
  float depth = 0;
  for (int s = 0; s < steps; ++s) depth += sampleBlocks(blockExtinction_, start + stride * static_cast<float>(s));
  return std::exp(-depth * step);
}

}  // namespace brisance
