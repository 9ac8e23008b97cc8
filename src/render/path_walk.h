// A path on its way, and what becomes of it.
#pragma once

#include <algorithm>
#include <optional>

#include "render/path_lights.h"
#include "render/path_tracer.h"
#include "render/scattering.h"

namespace brisance {

/// A path on its way.
struct Walk {
  Ray ray;
  Vec3f throughput{1, 1, 1};
  float density = 0;   ///< [1/sr] with which its direction was drawn; 0 for a single one: camera, mirror, smooth glass
  bool direct = true;  ///< nothing but mirrors and smooth glass since the camera
  bool towardsFire = false;  ///< drawn to find the gas alone: ends on surfaces that scatter
  float fireShare = 1;       ///< of the gas' light that counts, where a way drawn towards fire finds it as well
  int bounces = 0;           ///< off surfaces and smoke
  int mirrors = 0;           ///< and smooth glass
  int splits = 0;            ///< mirrors and glass surfaces at which both ways may still be followed

  Vec3f at(float distance) const { return ray.origin + ray.direction * distance; }
  void onward(const Vec3f& from, const Vec3f& direction, float near) {
    ray.origin = from;
    ray.direction = direction;
    ray.near = near;
  }
};

inline float largest(const Vec3f& colour) { return std::max({colour.x, colour.y, colour.z}); }

/// The share of light found in a direction of density `found` that counts, where a light draws it with `drawn`.
inline float share(float found, float drawn) { return found == 0 ? 1 : found / (found + drawn); }

/// Follows one path, and those that branch off.
class PathTracer {
 public:
  PathTracer(const PathWorld& world, float phase, const SampleSequence& numbers)
      : world_(world), phase_(phase), resolution_(world.geometry.resolution()), numbers_(numbers) {}
  Vec3f follow(Walk walk) { return follow(walk, world_.geometry.find(walk.ray)); }
  /// `found`: what the walk meets first.
  Vec3f follow(Walk walk, FoundTriangle found);

 private:
  enum class Fate { surface, scattered, ended };
  Fate crossGas(Walk& walk, float far, Vec3f& sum);
  Fate crossGasSeen(Walk& walk, const GasPath& path, Vec3f& sum);
  Vec3f followAside(const Walk& walk) { return PathTracer(world_, phase_, numbers_.branch()).follow(walk); }
  bool scatterInSmoke(Walk& walk, const Vec3f& place, Vec3f& sum);
  std::optional<FireCones> fireFrom(const Vec3f& place, const Vec3f& normal) const;
  template <class From, class Scatter>
  Vec3f firelight(Walk walk, const FireCones& fire, const From& from, const Scatter& scatter);
  Vec3f beyond(const Walk& walk) const;
  Vec3f ownLight(const Walk& walk, const SurfaceHit& hit) const;
  bool meetSurface(Walk& walk, const SurfaceHit& hit, Vec3f& sum);
  bool meetGlass(Walk& walk, const SurfaceHit& hit, Vec3f& sum);
  bool meetSmoothGlass(Walk& walk, const SurfaceHit& hit, const Vec3f& normal, float ratio, Vec3f& sum);
  bool meetOpaque(Walk& walk, const SurfaceHit& hit, Vec3f& sum);
  bool mirror(Walk& walk, const SurfaceHit& hit, const Vec3f& normal, const Vec3f& face, Vec3f& sum);
  bool scatter(Walk& walk, const SurfaceHit& hit, const SurfaceScattering& surface, const Vec3f& normal, Vec3f& sum);
  bool survives(Walk& walk);
  bool mayGoOn(const Walk& walk) const { return walk.mirrors < world_.maxDepth; }

  const PathWorld& world_;
  float phase_, resolution_;
  SampleSequence numbers_;
};

/// Light of the gas along one way drawn towards the fire. What gas sends and scatters on that whole way, through glass
/// and in mirrors too, counts by its share of the two ways that may go there: this one and the one on which the path
/// goes on (after Simon et al. 2017). `from(direction)`: where it begins.
template <class From, class Scatter>
Vec3f PathTracer::firelight(Walk walk, const FireCones& fire, const From& from, const Scatter& scatter) {
  const float choice = numbers_.number();
  const Vec3f direction = fire.sample(choice, numbers_.pair());
  const Returned returned = scatter(direction);
  if (returned.value == Vec3f{}) return {};
  walk.throughput = walk.throughput * returned.value / (fire.density(direction) + returned.density);
  walk.onward(from(direction), direction, resolution_);
  walk.towardsFire = true;
  walk.fireShare = 1;
  walk.direct = false;
  return followAside(walk);
}

}  // namespace brisance
