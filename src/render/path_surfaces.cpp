// What becomes of a path on surfaces: glass, mirrors, and those that scatter.
#include <algorithm>
#include <cmath>

#include "render/dielectric.h"
#include "render/path_walk.h"

namespace brisance {
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

}  // namespace brisance
