// What the path integrator asks of the gas: what passes, and collisions.
#include <cmath>

#include "base/vector_path.h"
#include "render/gas_steps.h"
#include "render/sample_sequence.h"

namespace brisance {

float GasMedium::transmittance(const GasPath& path) const {
  float depth = 0;
  const float mostDepth = -std::log(seeThrough);
  runWide([&] {
    alongSteps(path, [&](const GasSteps& steps) {
      for (int n = 0; n < steps.count; ++n) depth += steps.depth[n];
      return depth < mostDepth;
    });
  });
  return depth < mostDepth ? std::exp(-depth) : 0;
}

float GasMedium::distanceAtOpacity(const GasPath& path, float transmittance, float share) const {
  const float wanted = -std::log(1 - share * (1 - transmittance));
  float depth = 0, distance = path.far;
  bool passed = false;
  const auto pass = [&](const GasSteps& steps, int n) {
    const float own = steps.depth[n];
    passed = own > 0 && depth + own >= wanted;
    distance = passed ? steps.from[n] + steps.length(n) * (wanted - depth) / own : steps.to[n];
    depth += own;
  };
  runWide([&] {
    alongSteps(path, [&](const GasSteps& steps) {
      for (int n = 0; n < steps.count && !passed; ++n) pass(steps, n);
      return !passed;
    });
  });
  return distance;
}

std::optional<float> GasMedium::collision(const GasPath& path, NumberRun& numbers) const {
  std::optional<float> distance;
  runWide([&] { distance = collisionHere(path, numbers); });
  return distance;
}

std::optional<float> GasMedium::collisionHere(GasPath path, NumberRun& numbers) const {
  if (!clip(path)) return std::nullopt;
  const float perCell = 1 / cellSize_;
  const Vec3f origin = (path.origin - origin_) * perCell, direction = path.direction * perCell;
  BlockWalk walk(origin + direction * path.near, direction, path.near, blockLargest_.size);
  for (float at = path.near;; walk.next()) {
    const float leaves = walk.leaves(), out = std::min(leaves, path.far);
    const std::int32_t brick = brickOf_[walk.number()];
    const float most = brick < 0 ? 0 : optics_.extinction(blockLargest_.values[walk.number()]);
    while (most > 0) {
      at -= std::log(1 - numbers()) / most;
      if (at >= out) break;
      const GasSample sample = memory_.bricks[brick].at(origin + direction * at - walk.lower());
      if (numbers() * most < optics_.extinction(sample.density())) return at;
    }
    if (leaves >= path.far) return std::nullopt;
    at = out;
  }
}

}  // namespace brisance
