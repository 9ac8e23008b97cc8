#include "render/gas_medium.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "render/gas_steps.h"

namespace brisance {
namespace {

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

}  // namespace

GasOptics::GasOptics(const VolumeSettings& settings)
    : opacity_(static_cast<float>(settings.opacity)),
      minDensity_(static_cast<float>(settings.minDensity)),
      densityRange_(static_cast<float>(settings.maxDensity - settings.minDensity)),
      perFullDensity_(static_cast<float>(1 / settings.fullDensity)),
      emission_(static_cast<float>(settings.emission)),
      smokeColour_(settings.smokeColour) {}

GasMedium::GasMedium(const ParticleVolume& volume, const VolumeSettings& settings, BrickMemory memory)
    : size_(volume.density.size),
      cellSize_(static_cast<float>(volume.density.cellSize)),
      memory_(std::move(memory)),
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

void GasMedium::pack(const ParticleVolume& volume) {
  brickOf_.assign(blockLargest_.values.size(), -1);
  std::vector<std::int32_t> blocks;
  for (std::int32_t block = 0; block < std::ssize(brickOf_); ++block) {
    if (blockLargest_.values[block] <= 0) continue;
    brickOf_[block] = static_cast<std::int32_t>(blocks.size());
    blocks.push_back(block);
  }
  brickCount_ = static_cast<std::int32_t>(blocks.size());
  memory_.reserve(brickCount_);
  parallelFor(0, brickCount_, 16, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) {
      memory_.bricks[n].block = blocks[n];
      runWide([&] { packBrick(volume, memory_.bricks[n]); });
    }
  });
}

Vec3i GasMedium::blockAt(std::int32_t number) const {
  const Vec3i& n = blockLargest_.size;
  return {number % n.x, number / n.x % n.y, number / n.x / n.y};
}

/// Beyond the volume's last samples those hold.
void GasMedium::packBrick(const ParticleVolume& volume, GasBrick& brick) const {
  const Vec3i lower = blockAt(brick.block) * blockCells;
  GasSample samples[GasBrick::count];
  GasSample* to = samples;
  for (int z = 0; z < GasBrick::edge; ++z)
    for (int y = 0; y < GasBrick::edge; ++y) {
      const std::int64_t row =
          volume.density.index(0, std::min(lower.y + y, size_.y - 1), std::min(lower.z + z, size_.z - 1));
      for (int x = 0; x < GasBrick::edge; ++x) {
        const std::int64_t cell = row + std::min(lower.x + x, size_.x - 1);
        const float density = volume.density.values[cell];
        const Vec3f light = optics_.glow(volume.colour.values[cell]) * density;
        (to++)->values = GasSample::Vector{light.x, light.y, light.z, density};
      }
    }
  brick.encode(samples);
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

void GasMedium::bakeScattered() {
  parallelFor(0, brickCount_, 16, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) runWide([&] { bakeBrick(memory_.bricks[n]); });
  });
}

/// The light that a brick's samples scatter goes linearly between the centres of blocks: those of its own and of the
/// blocks around it, of which the outermost hold beyond.
void GasMedium::bakeBrick(GasBrick& brick) const {
  constexpr float perBlock = 1.0f / blockCells, centre = 0.5f * (blockCells - 1);
  const Vec3i block = blockAt(brick.block);
  Vec3f around[3][3][3];
  const auto clamped = [&](int axis, int offset) {
    return std::clamp(block[axis] + offset - 1, 0, blockScattered_.size[axis] - 1);
  };
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) around[z][y][x] = blockScattered_(clamped(0, x), clamped(1, y), clamped(2, z));
  GasSample samples[GasBrick::count];
  brick.decode(samples);
  GasSample* sample = samples;
  const auto mixed = [](const Vec3f* three, float place) {
    const int first = place < 1 ? 0 : 1;
    return three[first] + (three[first + 1] - three[first]) * (place - static_cast<float>(first));
  };
  const auto placeOf = [](int cell) { return 1 + (static_cast<float>(cell) - centre) * perBlock; };
  for (int z = 0; z < GasBrick::edge; ++z)
    for (int y = 0; y < GasBrick::edge; ++y) {
      Vec3f line[3];
      for (int x = 0; x < 3; ++x) {
        Vec3f layers[3];
        for (int layer = 0; layer < 3; ++layer) {
          const Vec3f column[3] = {around[layer][0][x], around[layer][1][x], around[layer][2][x]};
          layers[layer] = mixed(column, placeOf(y));
        }
        line[x] = mixed(layers, placeOf(z));
      }
      for (int x = 0; x < GasBrick::edge; ++x, ++sample) {
        const Vec3f light = mixed(line, placeOf(x)) * sample->density();
        sample->values += GasSample::Vector{light.x, light.y, light.z, 0};
      }
    }
  brick.encode(samples);
}

GasPassage GasMedium::march(const GasPath& path) const {
  GasPassage passage;
  runWide([&] { passage = marchHere(path); });
  return passage;
}

/// Equations A.3 and A.4.
GasPassage GasMedium::marchHere(const GasPath& path) const {
  GasSample::Vector light{};
  float transmittance = 1;
  alongSteps(path, [&](const GasSteps& steps) {
    for (int n = 0; n < steps.count; ++n) {
      light += steps.sample[n].values * ((1 - steps.passing[n]) * steps.perDensity[n] * transmittance);
      transmittance *= steps.passing[n];
      if (transmittance < seeThrough) transmittance = 0;
    }
    return transmittance > 0;
  });
  return {{light[0], light[1], light[2]}, transmittance};
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
  constexpr int lanes = 16;
  for (int first = 0; first < steps; first += lanes) {
    float extinction[lanes];
    for (int n = 0; n < lanes; ++n)  // those beyond the last are read at its place, and do not count
      extinction[n] =
          sampleBlocks(blockExtinction_, start + stride * static_cast<float>(std::min(first + n, steps - 1)));
    for (int n = 0; n < std::min(lanes, steps - first); ++n) depth += extinction[n];
  }
  return std::exp(-depth * step);
}

}  // namespace brisance
