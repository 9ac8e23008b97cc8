// Refining the grid keeps the explosion: heat and gas are spread over a kernel of fixed physical size.
#include <gtest/gtest.h>

#include <cstdlib>

#include "simulation/world.h"

namespace brisance {
namespace {

/// A charge in the middle of a box of 1 m a side.
SimulationSettings chargeIn(int cells) {
  SimulationSettings s;
  s.fluid.cells = {cells, cells, cells};
  s.fluid.cellSize = 1.0 / cells;
  Charge charge;
  charge.position = {.5, .5, .5};
  charge.particles = 1000;
  charge.ignited = 1000;
  s.particles.charges = {charge};
  return s;
}

Frame frameOf(const SimulationSettings& settings, int frame) {
  World world(settings);
  while (world.frameIndex() < frame) world.advance();
  return world.capture();
}

/// The radius about the middle that holds 90 % of the flame [m], between shells of a quarter of a cell.
double fireRadius(const Frame& frame) {
  const SparseGrid<float>& flame = frame.gas.flame;
  constexpr int shells = 4096;
  std::vector<double> inShell(shells, 0);
  double all = 0;
  for (const auto& brick : flame.bricks)
    for (int n = 0; n < 512; ++n) {
      const Vec3d cell(brick.corner + Vec3i(n % 8, n / 8 % 8, n / 64));
      const double radius = length(flame.origin + cell * flame.cellSize - Vec3d(.5, .5, .5));
      inShell[std::min(shells - 1, static_cast<int>(radius * shells))] += brick.values[n];
      all += brick.values[n];
    }
  double sum = 0;
  int shell = 0;
  while (shell < shells && sum < 0.9 * all) sum += inShell[shell++];
  return static_cast<double>(shell) / shells;
}

TEST(Resolution, TheFireballKeepsItsSizeOnAFinerGrid) {
  SimulationSettings coarse = chargeIn(16), fine = chargeIn(32);
  for (SimulationSettings* s : {&coarse, &fine}) s->particles.burning.depositRadius = 0.12;  // seen by the coarse one
  const double a = fireRadius(frameOf(coarse, 5)), b = fireRadius(frameOf(fine, 5));
  EXPECT_GT(a, 0.1);
  EXPECT_LT(a, 0.5);
  EXPECT_NEAR(a / b, 1, 0.1);
}

/// With the default kernel, from 32 to 128 cells: minutes, so only when asked for (./dev test --long).
TEST(Resolution, TheFireballKeepsItsSizeFrom32To128Cells) {
  if (!std::getenv("BRISANCE_LONG_TESTS")) GTEST_SKIP() << "takes minutes; ./dev test --long runs it";
  const double finest = fireRadius(frameOf(chargeIn(128), 5));
  for (const int cells : {32, 64}) {
    const double radius = fireRadius(frameOf(chargeIn(cells), 5));
    EXPECT_NEAR(radius / finest, 1, 0.1) << cells << " cells: " << radius << " m, 128 cells: " << finest << " m";
  }
}

}  // namespace
}  // namespace brisance
