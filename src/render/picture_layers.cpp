#include "render/picture_layers.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace brisance {
namespace {

/// Guides and what no chance decides cost little beside the light: they have more samples, and no noise is seen of
/// them.
constexpr int guideSamples = 32;
constexpr float nowhere = 1e10f;  // [m] as Blender has it: infinity survives no filter of a compositor

/// Bodies of one pixel in the order in which they were met.
class BodyShares {
 public:
  void add(std::uint32_t body, float share) {
    const auto known = std::find_if(shares_.begin(), shares_.end(), [&](const BodyShare& s) { return s.body == body; });
    if (known == shares_.end())
      shares_.push_back({body, share});
    else
      known->share += share;
  }
  RankedBodies ranked() {
    std::sort(shares_.begin(), shares_.end(), [](const BodyShare& a, const BodyShare& b) {
      return a.share != b.share ? a.share > b.share : a.body < b.body;
    });
    RankedBodies ranked{};
    std::copy_n(shares_.begin(), std::min<std::size_t>(shares_.size(), rankedBodies), ranked.begin());
    return ranked;
  }
  void clear() { shares_.clear(); }

 private:
  std::vector<BodyShare> shares_;
};

/// Where bodies move in the picture.
class Motion {
 public:
  explicit Motion(const LayersTask& task)
      : bodies_(task.bodies),
        now_(cameraAt(task.settings.camera, task.time.filmTime), task.settings.width, task.settings.height),
        next_(cameraAt(task.settings.camera, task.time.filmTime + task.time.frameDuration), task.settings.width,
              task.settings.height),
        frame_(task.time.frameDuration * task.time.simulatedPerFilm),
        open_(task.settings.camera.shutter * frame_) {}

  float depth(const Vec3d& place) const { return static_cast<float>(dot(place - now_.position(), now_.forward())); }

  /// Of a place that a ray met at `time` (0 .. 1) of the open shutter.
  Vec2<float> of(const FrameBody& body, const Vec3d& place, float time) const {
    if (!body.moves) return between(place, place);
    const Pose met = poseAfter(body, open_ * (time - 0.5));
    const Vec3d inBody = rotate(conjugate(met.orientation), place - met.position);
    return between(body.pose * inBody, poseAfter(body, frame_) * inBody);
  }

  const FrameBody& body(std::uint32_t number) const { return bodies_[number]; }

 private:
  Vec2<float> between(const Vec3d& place, const Vec3d& nextPlace) const {
    if (!isBefore(now_, place) || !isBefore(next_, nextPlace)) return {};
    const Vec2d from = now_.pixel(place), to = next_.pixel(nextPlace);
    return {static_cast<float>(to.x - from.x), static_cast<float>(from.y - to.y)};
  }
  static bool isBefore(const Camera& camera, const Vec3d& place) {
    return dot(place - camera.position(), camera.forward()) > 0;
  }

  const std::vector<FrameBody>& bodies_;
  Camera now_, next_;
  double frame_, open_;  // [s] simulated
};

/// Adds up the samples of one pixel after the other.
class LayerPixels {
 public:
  LayerPixels(const LayersTask& task, PictureLayers& layers, PictureGuides& guides)
      : task_(task), layers_(layers), guides_(guides), motion_(task) {
    const CameraKey view = cameraAt(task.settings.camera, task.time.filmTime);
    reach_ = static_cast<float>(brisance::length(view.lookAt - view.position));
    for (int s = 0; s < task.rays.perPixel(); ++s) weightOfHalf_[task.rays.field(s)] += task.rays.weight(s);
  }

  void draw(int x, int y, BodyShares& bodies) const {
    const std::size_t p = static_cast<std::size_t>(y) * layers_.width + x;
    bodies.clear();
    for (int s = 0; s < task_.rays.perPixel(); ++s) {
      const CameraRay sample = task_.rays.ray(x, y, s);
      const Sight sight = firstSight(task_.world, sample.ray, sample.phase);
      addToHalf(p, sight, task_.rays.field(s), task_.rays.weight(s));
      addLayers(p, sample.ray, sight, task_.rays.weight(s));
      if (!sight.found) continue;
      bodies.add(sight.first.body, task_.rays.weight(s));
      placeNearest(p, sample.ray, sight.first);
    }
    layers_.bodies[p] = bodies.ranked();
    layers_.alpha[p] = std::min(layers_.alpha[p], 1.0f);  // weights add up to 1 but for rounding
    if (task_.settings.denoise) drawGuides(x, y, p);
  }

 private:
  void drawGuides(int x, int y, std::size_t p) const {
    for (int s = 0; s < guideSamples; ++s) {
      const CameraRay sample = task_.rays.freeRay(x, y, s);
      addGuides(p, firstSight(task_.world, sample.ray, sample.phase), 1.0f / static_cast<float>(guideSamples));
    }
  }
  void addGuides(std::size_t p, const Sight& sight, float weight) const {
    guides_.certain.pixels[p] += sight.certain * weight;
    guides_.albedo.pixels[p] += sight.albedo * weight;
    guides_.clearness[p] += sight.clearness * weight;
    if (!sight.ends) return;
    guides_.normal.pixels[p] += sight.normal * weight;
    guides_.nearness[p] += weight * reach_ / (reach_ + sight.length);
  }
  void addToHalf(std::size_t p, const Sight& sight, int half, float weight) const {
    guides_.certainOfHalf[half].pixels[p] += sight.certain * (weight / weightOfHalf_[half]);
    guides_.albedoOfHalf[half].pixels[p] += sight.albedo * (weight / weightOfHalf_[half]);
  }
  void addLayers(std::size_t p, const Ray& ray, const Sight& sight, float weight) const {
    layers_.volume.pixels[p] += sight.gasLight * weight;
    layers_.volumeAlpha[p] += (1 - sight.gasTransmittance) * weight;
    layers_.albedo.pixels[p] += sight.albedo * weight;
    layers_.alpha[p] += sight.found ? weight : (1 - sight.gasTransmittance) * weight;
    if (sight.found) layers_.normal.pixels[p] += facing(sight.first, ray) * weight;
  }
  static Vec3f facing(const SurfaceHit& hit, const Ray& ray) {
    return dot(hit.normal, ray.direction) > 0 ? -hit.shadingNormal : hit.shadingNormal;
  }
  void placeNearest(std::size_t p, const Ray& ray, const SurfaceHit& hit) const {
    const Vec3d place(ray.origin + ray.direction * hit.distance);
    const float depth = motion_.depth(place);
    if (!(depth < layers_.depth[p])) return;
    layers_.depth[p] = depth;
    layers_.motion[p] = motion_.of(motion_.body(hit.body), place, ray.time);
  }

  const LayersTask& task_;
  PictureLayers& layers_;
  PictureGuides& guides_;
  Motion motion_;
  float reach_;  // [m]
  std::array<float, 2> weightOfHalf_{};
};

}  // namespace

void drawLayers(const LayersTask& task, PictureLayers& layers, PictureGuides& guides) {
  const int width = task.settings.width, height = task.settings.height;
  const std::size_t count = static_cast<std::size_t>(width) * height;
  layers = {width,
            height,
            std::vector<float>(count),
            Image(width, height),
            std::vector<float>(count),
            std::vector<float>(count, nowhere),
            Image(width, height),
            Image(width, height),
            std::vector<Vec2<float>>(count),
            std::vector<RankedBodies>(count),
            {}};
  for (const FrameBody& body : task.bodies) layers.bodyNames.push_back(body.name);
  const Image black(width, height);
  guides = {black, black, black, std::vector<float>(count), std::vector<float>(count), {black, black}, {black, black}};
  const LayerPixels pixels(task, layers, guides);
  parallelFor(0, height, 1, [&](std::int64_t first, std::int64_t last) {
    BodyShares bodies;
    for (int y = static_cast<int>(first); y < last; ++y)
      for (int x = 0; x < width; ++x) pixels.draw(x, y, bodies);
  });
}

}  // namespace brisance
