#include "render/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/dielectric.h"
#include "render/path_lights.h"

namespace brisance {
namespace {

float largest(const Vec3f& colour) { return std::max({colour.x, colour.y, colour.z}); }

/// A path on its way.
struct Walk {
  Ray ray;
  Vec3f throughput{1, 1, 1};
  float density = 0;   ///< [1/sr] with which its direction was drawn; 0 for a single one: camera, mirror, smooth glass
  bool direct = true;  ///< nothing but mirrors and smooth glass since the camera
  bool towardsFire = false;  ///< drawn to find fire alone: ends where light is scattered
  float fireShare = 1;       ///< of the fire it finds that counts, where a way towards fire finds it as well
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

/// The share of light found in a direction of density `found` that counts, where a light draws it with `drawn`.
float share(float found, float drawn) { return found == 0 ? 1 : found / (found + drawn); }

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

Vec3f PathTracer::follow(Walk walk, FoundTriangle found) {
  Vec3f sum;
  for (;; found = world_.geometry.find(walk.ray)) {
    const float far = found.isNone() ? std::numeric_limits<float>::max() : found.distance;
    const Fate fate = crossGas(walk, far, sum);
    if (fate == Fate::ended) return sum;
    if (fate == Fate::scattered) continue;
    if (found.isNone()) return walk.towardsFire ? sum : sum + walk.throughput * beyond(walk);
    if (!meetSurface(walk, world_.geometry.surfaceAt(found), sum) || !survives(walk)) return sum;
  }
}

/// Light from infinitely far away. The sun's disc is seen directly only: elsewhere lights are drawn from it.
Vec3f PathTracer::beyond(const Walk& walk) const {
  const Vec3f& direction = walk.ray.direction;
  Vec3f light = world_.environment(direction) * share(walk.density, world_.environment.density(direction));
  if (!walk.direct) return light;
  for (const LightSource& source : world_.lights) light += source.discSeenAlong(direction);
  return light;
}

/// What the gas up to a surface adds and takes.
PathTracer::Fate PathTracer::crossGas(Walk& walk, float far, Vec3f& sum) {
  if (!world_.gas) return Fate::surface;
  const GasPath path{walk.ray.origin, walk.ray.direction, walk.ray.near, far, phase_};
  if (walk.direct) return crossGasSeen(walk, path, sum);
  const GasPassage passage = world_.gas->march(path);
  sum += walk.throughput * passage.light * walk.fireShare;
  if (passage.transmittance == 1) return Fate::surface;
  if (walk.towardsFire || world_.smokeAlbedo == Vec3f{}) {
    walk.throughput *= passage.transmittance;
    return passage.transmittance > 0 ? Fate::surface : Fate::ended;
  }
  NumberRun run(numbers_.bits());
  const std::optional<float> collision = world_.gas->collision(path, run);
  if (!collision) return Fate::surface;
  return scatterInSmoke(walk, walk.at(*collision), sum) && survives(walk) ? Fate::scattered : Fate::ended;
}

/// What the camera sees is marched without noise; of the light that smoke scatters towards it one place is drawn.
PathTracer::Fate PathTracer::crossGasSeen(Walk& walk, const GasPath& path, Vec3f& sum) {
  const GasPassage passage = world_.gas->march(path);
  sum += walk.throughput * passage.light;
  if (world_.smokeAlbedo != Vec3f{} && passage.transmittance < 1) {
    Walk scattered = walk;
    scattered.throughput *= 1 - passage.transmittance;
    const float distance = world_.gas->distanceAtOpacity(path, passage.transmittance, numbers_.number());
    if (scatterInSmoke(scattered, walk.at(distance), sum)) sum += followAside(scattered);
  }
  walk.throughput *= passage.transmittance;
  return passage.transmittance > 0 ? Fate::surface : Fate::ended;
}

bool PathTracer::scatterInSmoke(Walk& walk, const Vec3f& place, Vec3f& sum) {
  if (walk.bounces >= world_.settings.maxBounces) return false;
  const Vec3f onward = walk.ray.direction;
  const auto returned = [&](const Vec3f& direction) {
    const float phase = phaseFunction(world_.anisotropy, dot(onward, direction));
    return Returned{{phase, phase, phase}, phase};
  };
  walk.throughput = walk.throughput * world_.smokeAlbedo;
  sum += walk.throughput * ArrivingLights(world_, place, walk.ray.time, phase_, returned).sum(numbers_);
  const std::optional<FireCones> fire = fireFrom(place, {});
  if (fire)
    sum += firelight(
        walk, *fire, [&](const Vec3f&) { return place; }, returned);
  const Vec2<float> where = numbers_.pair();
  const Vec3f next = samplePhase(world_.anisotropy, onward, where.x, where.y);
  walk.density = phaseFunction(world_.anisotropy, dot(onward, next));
  walk.fireShare = fire ? share(walk.density, fire->density(next)) : 1;
  walk.onward(place, next, 0);
  walk.direct = false;
  ++walk.bounces;
  return true;
}

std::optional<FireCones> PathTracer::fireFrom(const Vec3f& place, const Vec3f& normal) const {
  if (!world_.fire || world_.fire->isDark()) return std::nullopt;
  const FireCones fire(*world_.fire, place, normal);
  return fire.isDark() ? std::nullopt : std::optional(fire);
}

/// Light of the fire along one way drawn towards it. What it gathers on its whole way, through glass and in mirrors
/// too, counts by its share of the two ways that may go there: this one and the one on which the path goes on (after
/// Simon et al. 2017). `from(direction)`: where it begins.
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

Vec3f PathTracer::ownLight(const Walk& walk, const SurfaceHit& hit) const {
  const SurfaceMaterial& material = world_.materials[hit.material];
  if (material.settings.emission == Vec3f{}) return {};
  const float cosine = std::abs(dot(hit.normal, walk.ray.direction));
  const float drawn = world_.shining.density(hit.material) * hit.distance * hit.distance / std::max(cosine, 1e-6f);
  return material.diffuseColour(hit.texture) * material.settings.emission * share(walk.density, drawn);
}

bool PathTracer::meetSurface(Walk& walk, const SurfaceHit& hit, Vec3f& sum) {
  if (world_.materials[hit.material].settings.glass) return meetGlass(walk, hit, sum);
  if (!walk.towardsFire) sum += walk.throughput * ownLight(walk, hit);
  return meetOpaque(walk, hit, sum);
}

/// Between touching pieces of one glass there is no surface: the path goes on as if they were whole.
bool PathTracer::meetGlass(Walk& walk, const SurfaceHit& hit, Vec3f& sum) {
  const SurfaceMaterial& material = world_.materials[hit.material];
  const bool leaving = dot(walk.ray.direction, hit.normal) > 0;
  const bool touching = world_.geometry.touchesSameGlass(walk.ray, hit);
  if (leaving)
    walk.throughput = walk.throughput * beerTransmittance(material.settings.absorption, hit.distance - walk.ray.near);
  if (touching) {
    walk.ray.near = hit.distance + resolution_;
    return true;
  }
  Vec3f normal = leaving ? -hit.shadingNormal : hit.shadingNormal;
  if (dot(normal, walk.ray.direction) >= 0) normal = leaving ? -hit.normal : hit.normal;
  const SurfaceScattering glass = material.glass(leaving);
  if (const auto* smooth = std::get_if<SmoothDielectric>(&glass))
    return meetSmoothGlass(walk, hit, normal, smooth->ratio, sum);
  return scatter(walk, hit, glass, normal, sum);
}

bool PathTracer::meetSmoothGlass(Walk& walk, const SurfaceHit& hit, const Vec3f& normal, float ratio, Vec3f& sum) {
  if (!mayGoOn(walk)) return false;
  const Vec3f direction = walk.ray.direction, place = walk.at(hit.distance);
  const std::optional<Vec3f> through = refracted(direction, normal, ratio);
  const float mirrorShare = through ? fresnelReflectance(-dot(direction, normal), ratio) : 1;
  walk.density = 0;
  ++walk.mirrors;
  bool reflects = !through;
  if (through && walk.direct && walk.splits > 0) {
    --walk.splits;
    Walk other = walk;
    other.throughput *= mirrorShare;
    other.onward(place, reflected(direction, normal), resolution_);
    sum += followAside(other);
    walk.throughput *= 1 - mirrorShare;
  } else if (through) {
    reflects = numbers_.number() < mirrorShare;
  }
  walk.onward(place, reflects ? reflected(direction, normal) : *through, resolution_);
  return true;
}

/// A surface seen from either side (pieces of fractured shells are open).
bool PathTracer::meetOpaque(Walk& walk, const SurfaceHit& hit, Vec3f& sum) {
  const SurfaceMaterial& material = world_.materials[hit.material];
  const Vec3f face = dot(walk.ray.direction, hit.normal) > 0 ? -hit.normal : hit.normal;
  Vec3f normal = dot(hit.shadingNormal, face) < 0 ? -hit.shadingNormal : hit.shadingNormal;
  if (dot(normal, walk.ray.direction) >= 0) normal = face;
  if (material.settings.reflection != Vec3f{} && mirror(walk, hit, normal, face, sum)) return true;
  return scatter(walk, hit, material.opaque(hit.texture), normal, sum);
}

/// The perfect mirror in a surface; true when the path goes on in it.
bool PathTracer::mirror(Walk& walk, const SurfaceHit& hit, const Vec3f& normal, const Vec3f& face, Vec3f& sum) {
  const Vec3f& colour = world_.materials[hit.material].settings.reflection;
  const bool bothWays = walk.direct && walk.splits > 0;
  const float chance = largest(colour) / (largest(colour) + 1);
  const bool chosen = bothWays || numbers_.number() < chance;
  if (!chosen) {
    walk.throughput *= 1 / (1 - chance);
    return false;
  }
  if (!mayGoOn(walk)) return false;
  Walk other = walk;
  other.throughput = walk.throughput * colour * (bothWays ? 1 : 1 / chance);
  other.density = 0;
  ++other.mirrors;
  Vec3f mirrored = reflected(walk.ray.direction, normal);
  if (dot(mirrored, face) <= 0) mirrored = reflected(walk.ray.direction, face);  // bent into the surface
  other.onward(walk.at(hit.distance) + face * resolution_, mirrored, resolution_);
  if (!bothWays) {
    walk = other;
    return true;
  }
  --other.splits;
  sum += followAside(other);
  return false;
}

/// Light of the lights, and the way on.
bool PathTracer::scatter(Walk& walk, const SurfaceHit& hit, const SurfaceScattering& surface, const Vec3f& normal,
                         Vec3f& sum) {
  if (walk.towardsFire || walk.bounces >= world_.settings.maxBounces) return false;
  const Axes axes(normal, hit.alongU);
  const Vec3f out = axes.toLocal(-walk.ray.direction), place = walk.at(hit.distance);
  const Vec3f face = dot(walk.ray.direction, hit.normal) > 0 ? -hit.normal : hit.normal;
  // A direction on one side of the smooth normal and the other side of the triangle would leak through it.
  const auto leaks = [&](const Vec3f& direction, float local) { return (dot(direction, face) > 0) != (local > 0); };
  const auto returned = [&](const Vec3f& direction) {
    const Vec3f in = axes.toLocal(direction);
    return leaks(direction, in.z) ? Returned{{}, 0} : Returned{value(surface, out, in), density(surface, out, in)};
  };
  sum += walk.throughput *
         ArrivingLights(world_, place + face * resolution_, walk.ray.time, phase_, returned).sum(numbers_);
  const bool oneSided = !std::holds_alternative<RoughDielectric>(surface);
  const std::optional<FireCones> fire = fireFrom(place, oneSided ? normal : Vec3f{});
  const auto beside = [&](const Vec3f& direction) {
    return place + (dot(direction, face) > 0 ? face : -face) * resolution_;
  };
  if (fire) sum += firelight(walk, *fire, beside, returned);
  const Vec2<float> where = numbers_.pair();
  const auto next = sample(surface, out, {where.x, where.y, numbers_.number()});
  if (!next) return false;
  const Vec3f direction = axes.toWorld(next->in);
  if (leaks(direction, next->in.z)) return false;
  walk.throughput = walk.throughput * next->weight;
  walk.density = next->density;
  walk.fireShare = fire ? share(walk.density, fire->density(direction)) : 1;
  walk.direct = false;
  ++walk.bounces;
  walk.onward(beside(direction), direction, resolution_);
  return true;
}

/// Faint paths end at random; those that go on count for them (Arvo & Kirk 1990).
bool PathTracer::survives(Walk& walk) {
  const float rest = largest(walk.throughput), faint = static_cast<float>(world_.settings.faint);
  if (!(rest > 0)) return false;
  if (rest >= faint) return true;
  const float chance = rest / faint;
  if (numbers_.number() >= chance) return false;
  walk.throughput *= 1 / chance;
  return true;
}

}  // namespace

namespace {

Walk fromCamera(const PathWorld& world, const Ray& ray) {
  Walk walk;
  walk.ray = ray;
  walk.splits = world.settings.splits;
  return walk;
}

}  // namespace

Vec3f pathRadiance(const PathWorld& world, const Ray& ray, float phase, SampleSequence& numbers) {
  return PathTracer(world, phase, numbers).follow(fromCamera(world, ray));
}

void pathRadiance(const PathWorld& world, std::span<CameraRay> rays, std::span<Vec3f> light) {
  std::array<Ray, SceneGeometry::packet> ways;
  std::array<FoundTriangle, SceneGeometry::packet> found;
  for (std::size_t n = 0; n < rays.size(); ++n) ways[n] = rays[n].ray;
  world.geometry.find(std::span(ways).first(rays.size()), found);
  for (std::size_t n = 0; n < rays.size(); ++n)
    light[n] = PathTracer(world, rays[n].phase, rays[n].numbers).follow(fromCamera(world, ways[n]), found[n]);
}

}  // namespace brisance
