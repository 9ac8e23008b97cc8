#include "view/compact_gas.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

int longest(const Vec3i& size) { return std::max({size.x, size.y, size.z}); }

VolumeSettings withCells(VolumeSettings settings, double cellSize) {
  const auto cells = [&](int count) {
    return std::max(1, static_cast<int>(std::ceil(count * settings.cellSize / cellSize - 1e-9)));
  };
  settings.cells = {cells(settings.cells.x), cells(settings.cells.y), cells(settings.cells.z)};
  settings.cellSize = cellSize;
  settings.filterSize = 0;
  return settings;
}

/// Cells that the whole volume could have, to find the box that the particles fill; then as fine as that box allows.
bool volumeOfParticles(const Frame& frame, const VolumeSettings& settings, const BlackbodyColours& heat, int cells,
                       ParticleVolume& volume) {
  constexpr double cellsPerBlur = 1.25;  // a Gaussian is smooth between samples 0.8 deviations apart
  SplatScratch scratch;
  const double finest = std::max(settings.cellSize, settings.blur / cellsPerBlur);
  double cellSize = std::max(finest, settings.cellSize * longest(settings.cells) / (cells - 1));
  if (!drawnVolume(frame, withCells(settings, cellSize), heat, volume, scratch)) return false;
  const double wanted = std::max(finest, cellSize * longest(volume.density.size) / (cells - 2));
  if (wanted >= cellSize) return true;
  for (cellSize = wanted;; cellSize *= 1.05) {
    drawnVolume(frame, withCells(settings, cellSize), heat, volume, scratch);
    if (longest(volume.density.size) <= cells) return true;
  }
}

/// Means over blocks of `n` cells along each axis; colours weighed by density.
ParticleVolume coarsened(const ParticleVolume& fine, int n) {
  const Vec3i& size = fine.density.size;
  const Vec3i fewer{(size.x + n - 1) / n, (size.y + n - 1) / n, (size.z + n - 1) / n};
  const double toCentre = 0.5 * (n - 1) * fine.density.cellSize;
  const Vec3d origin = fine.density.origin + Vec3d(toCentre, toCentre, toCentre);
  ParticleVolume coarse{{fewer, origin, n * fine.density.cellSize}, {fewer, origin, n * fine.density.cellSize}};
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const float density = fine.density(i, j, k);
        coarse.density(i / n, j / n, k / n) += density;
        coarse.colour(i / n, j / n, k / n) += fine.colour(i, j, k) * density;
      }
  const float share = 1.0f / static_cast<float>(n * n * n);
  for (std::size_t cell = 0; cell < coarse.density.values.size(); ++cell) {
    float& density = coarse.density.values[cell];
    if (density > 0) coarse.colour.values[cell] = coarse.colour.values[cell] * (1 / density);
    density *= share;
  }
  return coarse;
}

bool volumeOf(const Frame& frame, const VolumeSettings& settings, const BlackbodyColours& heat, int cells,
              ParticleVolume& volume) {
  if (settings.source == VolumeSource::particles) return volumeOfParticles(frame, settings, heat, cells, volume);
  SplatScratch scratch;
  if (!drawnVolume(frame, settings, heat, volume, scratch)) return false;
  if (const int found = longest(volume.density.size); found > cells)
    volume = coarsened(volume, (found + cells - 1) / cells);
  return true;
}

std::uint8_t levelOf(double share, int levels) { return static_cast<std::uint8_t>(std::lround((levels - 1) * share)); }

std::uint8_t median(std::uint8_t left, std::uint8_t below, std::uint8_t lowerLeft) {
  const int sum = left + below - lowerLeft;
  return static_cast<std::uint8_t>(std::clamp(sum, std::min<int>(left, below), std::max<int>(left, below)));
}

std::uint8_t foretold(const std::vector<std::uint8_t>& values, const Vec3i& size, int i, int j, std::size_t cell) {
  const std::size_t row = size.x, slice = row * size.y;
  if (i > 0 && j > 0) return median(values[cell - 1], values[cell - row], values[cell - row - 1]);
  if (i > 0) return values[cell - 1];
  if (j > 0) return values[cell - row];
  return cell >= slice ? values[cell - slice] : 0;
}

}  // namespace

std::optional<CompactGas> compactGas(const Frame& frame, const VolumeSettings& settings, const BlackbodyColours& heat,
                                     const HeatScale& scale, int cells) {
  ParticleVolume volume;
  if (!volumeOf(frame, settings, heat, cells, volume)) return std::nullopt;
  const Grid3<float>& density = volume.density;
  CompactGas gas{density.size, density.origin, density.cellSize, {}, {}};
  gas.density.reserve(density.values.size());
  gas.heat.reserve(density.values.size());
  for (std::size_t cell = 0; cell < density.values.size(); ++cell) {
    const double share = std::clamp(density.values[cell] / settings.fullDensity, 0.0, 1.0);
    gas.density.push_back(levelOf(std::sqrt(share), densityLevels));
    gas.heat.push_back(levelOf(scale.ofLight(volume.colour.values[cell]) / double(HeatScale::steps - 1), heatLevels));
  }
  return gas;
}

std::vector<std::uint8_t> residuals(const std::vector<std::uint8_t>& values, const Vec3i& size) {
  return residuals(values, std::vector<std::uint8_t>(values.size(), 1), size);
}

std::vector<std::uint8_t> residuals(const std::vector<std::uint8_t>& values, const std::vector<std::uint8_t>& mask,
                                    const Vec3i& size) {
  std::vector<std::uint8_t> known = values, left(values.size());
  std::size_t cell = 0;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i, ++cell) {
        const std::uint8_t guess = foretold(known, size, i, j, cell);
        if (mask[cell] == 0) known[cell] = guess;
        left[cell] = static_cast<std::uint8_t>(known[cell] - guess);
      }
  return left;
}

}  // namespace brisance
