#include "render/path_tracer.h"

#include <limits>

#include "render/path_walk.h"

namespace brisance {

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
  if (world_.smokeAlbedo == Vec3f{}) {
    walk.throughput *= passage.transmittance;
    return passage.transmittance > 0 ? Fate::surface : Fate::ended;
  }
  NumberRun run(numbers_.bits());
  const std::optional<float> collision = world_.gas->collision(path, run);
  if (!collision) return Fate::surface;
  walk.throughput *= walk.fireShare;
  walk.towardsFire = false;
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

/// Where the camera sees it, a way towards the fire is drawn beside the way on, else the way on is drawn by either: so
/// ways in smoke do not become more and more.
bool PathTracer::scatterInSmoke(Walk& walk, const Vec3f& place, Vec3f& sum) {
  if (walk.bounces >= world_.settings.maxBounces) return false;
  const Vec3f onward = walk.ray.direction;
  const std::optional<FireCones> fire = fireFrom(place, {});
  const bool both = walk.direct, either = fire && !both;
  const auto returned = [&](const Vec3f& direction) {
    const float phase = phaseFunction(world_.anisotropy, dot(onward, direction));
    return Returned{{phase, phase, phase}, either ? 0.5f * (phase + fire->density(direction)) : phase};
  };
  walk.throughput = walk.throughput * world_.smokeAlbedo;
  sum += walk.throughput * ArrivingLights(world_, place, walk.ray.time, phase_, returned).sum(numbers_);
  if (fire && both)
    sum += firelight(
        walk, *fire, [&](const Vec3f&) { return place; }, returned);
  const float choice = numbers_.number();
  const Vec2<float> where = numbers_.pair();
  const Vec3f next = either && choice < 0.5f ? fire->sample(2 * choice, where)
                                             : samplePhase(world_.anisotropy, onward, where.x, where.y);
  const Returned back = returned(next);
  walk.throughput = walk.throughput * back.value / back.density;
  walk.density = back.density;
  walk.fireShare = fire && both ? share(walk.density, fire->density(next)) : 1;
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
