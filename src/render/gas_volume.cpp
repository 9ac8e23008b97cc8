#include "render/gas_volume.h"

#include "base/parallel.h"

namespace brisance {
namespace {

constexpr Vec3i one{1, 1, 1}, brickSize{8, 8, 8};

struct CellBox {
  Vec3i lower{1 << 30, 1 << 30, 1 << 30}, upper{-1, -1, -1};  // [cells], both included
  void include(const SparseGrid<float>& grid) {
    for (const auto& brick : grid.bricks) {
      lower = min(lower, brick.corner);
      upper = max(upper, min(brick.corner + brickSize, grid.size) - one);
    }
  }
};

template <class T>
void layOut(Grid3<T>& grid, const SparseGrid<float>& like, const CellBox& box, const T& value) {
  grid.size = box.upper - box.lower + one + one + one;
  grid.cellSize = like.cellSize;
  grid.origin = like.origin + Vec3d(box.lower - one) * like.cellSize;
  grid.values.assign(static_cast<std::size_t>(grid.size.x) * grid.size.y * grid.size.z, value);
}

/// Calls visit(value in `to`, value of the gas) for the samples of all bricks that lie in the box.
template <class T, class Visit>
void forBricks(const SparseGrid<float>& from, const CellBox& box, Grid3<T>& to, const Visit& visit) {
  parallelFor(0, std::ssize(from.bricks), 16, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) {
      const auto& brick = from.bricks[n];
      forSamplesOf(brick.corner, from.size, [&](int sample, int i, int j, int k) {
        const Vec3i cell = Vec3i(i, j, k) - box.lower + one;
        if (min(cell, Vec3i{}) == Vec3i{} && max(cell, to.size - one) == to.size - one)
          visit(to(cell.x, cell.y, cell.z), brick.values[sample]);
      });
    }
  });
}

}  // namespace

bool hasGas(const FrameGas& gas) { return !gas.density.bricks.empty() || !gas.flame.bricks.empty(); }

void gasVolume(const FrameGas& gas, const VolumeSettings& settings, const BlackbodyColours& heat,
               ParticleVolume& volume) {
  CellBox box;
  box.include(gas.density);
  box.include(gas.flame);
  const SparseGrid<float>& like = gas.density.bricks.empty() ? gas.flame : gas.density;
  layOut(volume.density, like, box, 0.0f);
  layOut(volume.colour, like, box, heat(gas.temperature.background));
  const auto fuelWeight = static_cast<float>(settings.fuelWeight);
  forBricks(gas.density, box, volume.density, [](float& density, float soot) { density += soot; });
  forBricks(gas.flame, box, volume.density, [&](float& density, float flame) { density += fuelWeight * flame; });
  forBricks(gas.temperature, box, volume.colour, [&](Vec3f& colour, float kelvin) { colour = heat(kelvin); });
}

}  // namespace brisance
