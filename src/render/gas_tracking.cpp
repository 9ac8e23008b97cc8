// What the path integrator asks of the gas: shared marching, collisions, places that shine.
#include <cmath>

#include "base/vector_path.h"
#include "render/fire_sampler.h"
#include "render/gas_steps.h"
#include "render/sample_sequence.h"

namespace brisance {

GasPassage GasMedium::marchShared(const GasPath& path, float density, const FireSampler& fire) const {
  GasPassage passage;
  runWide([&] {
    alongSteps(path, [&](const GasStep& step) {
      const Vec3f before = passage.light;
      addStep(step.place, step.to - step.from, passage);
      const float distance = 0.5f * (step.from + step.to);
      const float drawn = fire.density(step.block, step.place) * distance * distance;  // [1/sr] there
      passage.light = before + (passage.light - before) * (density / (density + drawn));
      return passage.transmittance > 0;
    });
  });
  return passage;
}

float GasMedium::transmittance(const GasPath& path) const {
  float depth = 0;
  const float mostDepth = -std::log(seeThrough);
  runWide([&] {
    alongSteps(path, [&](const GasStep& step) {
      depth += optics_.extinction(sampleAt(step.place).density()) * (step.to - step.from);
      return depth < mostDepth;
    });
  });
  return depth < mostDepth ? std::exp(-depth) : 0;
}

float GasMedium::distanceAtOpacity(const GasPath& path, float transmittance, float share) const {
  const float wanted = -std::log(1 - share * (1 - transmittance));
  float depth = 0, distance = path.far;
  runWide([&] {
    alongSteps(path, [&](const GasStep& step) {
      const float own = optics_.extinction(sampleAt(step.place).density()) * (step.to - step.from);
      const bool passed = own > 0 && depth + own >= wanted;
      distance = passed ? step.from + (step.to - step.from) * (wanted - depth) / own : step.to;
      depth += own;
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
  const GridWay way{(path.origin - origin_) * perCell, path.direction * perCell};
  const float nudge = 1e-4f * cellSize_;  // into the next block
  for (float at = path.near; at < path.far;) {
    const Vec3i block = way.block(way.at(at), blockLargest_.size);
    const float out = std::max(std::min(way.leaves(block, blockLargest_.size), path.far), at) + nudge;
    const float most = optics_.extinction(blockLargest_(block.x, block.y, block.z));
    while (most > 0) {
      at -= std::log(1 - numbers()) / most;
      if (at >= out) break;
      if (numbers() * most < optics_.extinction(sampleAt(way.at(at)).density()))
        return at < path.far ? std::optional(at) : std::nullopt;
    }
    at = out;
  }
  return std::nullopt;
}

Vec3f GasMedium::emissionAtCell(const Vec3f& place) const {
  const GasSample sample = sampleAt(place);
  return sample.density() > 0 ? sample.light() * optics_.extinction(sample.density()) : Vec3f{};
}

}  // namespace brisance
