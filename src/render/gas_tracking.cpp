// What the path integrator asks of the gas: shared marching, collisions, places that shine.
#include <cmath>

#include "base/vector_path.h"
#include "render/fire_sampler.h"
#include "render/gas_steps.h"
#include "render/sample_sequence.h"

namespace brisance {

GasPassage GasMedium::marchShared(const GasPath& path, float density, const FireSampler& fire) const {
  const float perCell = 1 / cellSize_;
  const Vec3f start = (path.origin - origin_) * perCell, slope = path.direction * perCell;
  GasSample::Vector light{};
  float transmittance = 1;
  runWide([&] {
    alongSteps(path, [&](const GasSteps& steps) {
      for (int n = 0; n < steps.count; ++n) {
        const float distance = steps.middle(n);
        const std::int32_t block = memory_.bricks[steps.brick[n]].block;
        const float drawn = fire.density(block, start + slope * distance) * distance * distance;
        const float found = density * steps.depth[n], elsewise = drawn * steps.length(n);  // [1/sr] in this step
        const float share = found > 0 ? found / (found + elsewise) : 0;
        light += steps.sample[n].values * ((1 - steps.passing[n]) * steps.perDensity[n] * transmittance * share);
        transmittance *= steps.passing[n];
        if (transmittance < seeThrough) transmittance = 0;
      }
      return transmittance > 0;
    });
  });
  return {{light[0], light[1], light[2]}, transmittance};
}

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

Vec3f GasMedium::emissionAtCell(const Vec3f& place) const {
  const GasSample sample = sampleAt(place);
  return sample.density() > 0 ? sample.light() * optics_.extinction(sample.density()) : Vec3f{};
}

}  // namespace brisance
