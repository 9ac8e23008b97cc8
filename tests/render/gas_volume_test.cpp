// The gas' own cells as the volume of a picture.
#include "render/gas_volume.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/render_frame.h"

using namespace brisance;

namespace {

constexpr int cells = 24;
constexpr double cellSize = 0.1, ambient = 300;

SparseGrid<float> emptyGrid(float background) {
  SparseGrid<float> grid;
  grid.size = {cells, cells, cells};
  grid.origin = {-1.15, -1.15, -1.15};
  grid.cellSize = cellSize;
  grid.background = background;
  return grid;
}

/// A brick with `value` in its cell (x, y, z), the background elsewhere.
void addBrick(SparseGrid<float>& grid, const Vec3i& corner, const Vec3i& cell, float value) {
  SparseGrid<float>::Brick brick{corner, {}};
  brick.values.fill(grid.background);
  brick.values[cell.x + 8 * (cell.y + 8 * cell.z)] = value;
  grid.bricks.push_back(brick);
}

/// Soot in cell (10, 9, 8), soot that burns in cell (17, 9, 8), where it is hot.
FrameGas smallGas() {
  FrameGas gas{emptyGrid(0), emptyGrid(ambient), emptyGrid(0), {}};
  addBrick(gas.density, {8, 8, 8}, {2, 1, 0}, 0.5f);
  addBrick(gas.density, {16, 8, 8}, {1, 1, 0}, 0.25f);
  addBrick(gas.flame, {16, 8, 8}, {1, 1, 0}, 3);
  addBrick(gas.temperature, {16, 8, 8}, {1, 1, 0}, 1800);
  return gas;
}

}  // namespace

TEST(GasVolume, IsSootAndWeighedFlameInTheColourOfTheirHeat) {
  VolumeSettings settings;
  settings.fuelWeight = 0.5;
  const BlackbodyColours heat(settings.blackbody);
  ParticleVolume volume;
  gasVolume(smallGas(), settings, heat, volume);
  const auto cellOf = [&](const Vec3i& cell) {
    const Vec3d at = (Vec3d(cell) * cellSize + Vec3d(-1.15, -1.15, -1.15) - volume.density.origin) / cellSize;
    return volume.density.index(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)),
                                static_cast<int>(std::lround(at.z)));
  };
  EXPECT_EQ(volume.density.values[cellOf({10, 9, 8})], 0.5f);
  EXPECT_EQ(volume.density.values[cellOf({17, 9, 8})], 0.25f + 0.5f * 3);
  EXPECT_EQ(volume.density.values[cellOf({12, 12, 12})], 0);
  EXPECT_EQ(volume.colour.values[cellOf({10, 9, 8})], heat(ambient));
  EXPECT_EQ(volume.colour.values[cellOf({17, 9, 8})], heat(1800));
}

// Only the bricks that hold gas are laid out, and a border of empty cells, so that the gas fades out.
TEST(GasVolume, CoversWhatIsThereAndABorder) {
  ParticleVolume volume;
  const VolumeSettings settings;
  gasVolume(smallGas(), settings, BlackbodyColours(settings.blackbody), volume);
  EXPECT_EQ(volume.density.size, Vec3i(18, 10, 10));
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 10; ++j) EXPECT_EQ(volume.density(0, j, k) + volume.density(17, j, k), 0);
}

TEST(GasVolume, IsDrawnWithoutParticles) {
  Frame frame;
  frame.gas = smallGas();
  RenderSettings settings;
  settings.width = settings.height = 24;
  settings.camera.keys = {{0, {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40}};
  settings.background = {0.1f, 0.1f, 0.1f};
  settings.volume.fullDensity = 0.5;
  settings.volume.opacity = 40;
  const auto brightest = [&](VolumeSource source) {
    settings.volume.source = source;
    float largest = 0;
    for (const Vec3f& pixel : renderFrame(frame, settings).pixels) largest = std::max(largest, pixel.x);
    return largest;
  };
  EXPECT_NEAR(brightest(VolumeSource::particles), 0.1f, 1e-6f);
  EXPECT_GT(brightest(VolumeSource::gas), 0.2f);
}
