#include "render/whitted.h"

#include <cmath>
#include <limits>

#include "render/dielectric.h"

namespace brisance {
namespace {

/// Rays that carry less than this of a pixel see the background: of fire ten times brighter than white that is a
/// fiftieth of white.
constexpr float negligibleShare = 1.0f / 512;
/// Light fainter than this of white needs no shadow ray: far below what 8 bits show in the dark.
constexpr float negligibleLight = 1e-4f;

float largest(const Vec3f& colour) { return std::max({colour.x, colour.y, colour.z}); }

/// A ray on its way through the scene.
struct Travel {
  Ray ray;
  float phase;  ///< of the samples in the gas
  int depth;    ///< mirrors and glass surfaces behind it
  float share;  ///< of the pixel
};

/// A place on a surface, as light falls on it.
struct LitPlace {
  SurfaceScattering surface;
  Axes axes;
  Vec3f out;    ///< to the viewer, local
  Vec3f place;  ///< [m], just before the surface
};

class Tracer {
 public:
  explicit Tracer(const RayWorld& world) : world_(world), resolution_(world.geometry.resolution()) {}
  Vec3f light(const Travel& travel) const;

 private:
  Vec3f surfaceLight(const Travel& travel, const SurfaceHit& hit) const;
  Vec3f opaqueLight(const Travel& travel, const SurfaceHit& hit) const;
  Vec3f glassLight(const Travel& travel, const SurfaceHit& hit) const;
  Vec3f beyondGlassSurface(const Travel& travel, const SurfaceHit& hit, const Vec3f& normal) const;
  Vec3f lit(const LitPlace& lit, float time, bool fireToo) const;
  Vec3f next(const Travel& travel, const SurfaceHit& hit, const Vec3f& direction, float share) const;
  float gasTransmittance(const Ray& ray, float distance, const LightSource& light) const;

  const RayWorld& world_;
  float resolution_;
};

/// Gas up to the first surface, then what that surface returns: so fire and glass cover one another rightly at any
/// depth.
Vec3f Tracer::light(const Travel& travel) const {
  SurfaceHit hit;
  const bool found = world_.geometry.closest(travel.ray, hit);
  const float far = found ? hit.distance : std::numeric_limits<float>::max();
  GasPassage gas;
  if (world_.gas)
    gas = world_.gas->march({travel.ray.origin, travel.ray.direction, travel.ray.near, far, travel.phase});
  if (gas.transmittance == 0) return gas.light;
  Travel behind = travel;
  behind.share *= gas.transmittance;
  return gas.light + (found ? surfaceLight(behind, hit) : world_.background(travel.ray.direction)) * gas.transmittance;
}

Vec3f Tracer::surfaceLight(const Travel& travel, const SurfaceHit& hit) const {
  return world_.materials[hit.material].settings.glass ? glassLight(travel, hit) : opaqueLight(travel, hit);
}

/// Follows a mirror or glass ray from a hit, unless it is too deep or carries too little to be seen.
Vec3f Tracer::next(const Travel& travel, const SurfaceHit& hit, const Vec3f& direction, float share) const {
  if (travel.depth >= world_.maxDepth || travel.share * share < negligibleShare) return world_.background(direction);
  const float shifted = travel.phase + 0.618034f;  // the golden ratio spreads the phases of a family of rays evenly
  return light({{travel.ray.origin + travel.ray.direction * hit.distance, direction, resolution_, travel.ray.time},
                shifted - std::floor(shifted),
                travel.depth + 1,
                travel.share * share});
}

/// The lighting model, seen from either side (pieces of fractured shells are open).
Vec3f Tracer::opaqueLight(const Travel& travel, const SurfaceHit& hit) const {
  const SurfaceMaterial& material = world_.materials[hit.material];
  const Vec3f& direction = travel.ray.direction;
  const Vec3f face = dot(direction, hit.normal) > 0 ? -hit.normal : hit.normal;
  const Vec3f normal = dot(hit.shadingNormal, face) < 0 ? -hit.shadingNormal : hit.shadingNormal;
  const Vec3f colour = material.diffuseColour(hit.texture);
  const Vec3f place = travel.ray.origin + direction * hit.distance + face * resolution_;
  const Axes axes(normal, hit.alongU);
  Vec3f light = colour * (material.settings.ambient * world_.ambientLight + material.settings.emission) +
                lit({material.opaque(hit.texture), axes, axes.toLocal(-direction), place}, travel.ray.time, true);
  const Vec3f& mirror = material.settings.reflection;
  if (mirror == Vec3f{}) return light;
  Vec3f mirrored = reflected(direction, normal);
  if (dot(mirrored, face) <= 0) mirrored = reflected(direction, face);  // a smooth normal bent it into the surface
  return light + mirror * next(travel, hit, mirrored, largest(mirror));
}

/// The direct lights. I_s is what a white diffuse surface returns: irradiance over pi.
Vec3f Tracer::lit(const LitPlace& lit, float time, bool fireToo) const {
  Vec3f sum;
  for (const LightSource& source : world_.lights) {
    if (source.kind == LightSource::Kind::fire && !fireToo) continue;
    const ArrivingLight arriving = source.at(lit.place);
    const Vec3f returned =
        value(lit.surface, lit.out, lit.axes.toLocal(arriving.toLight)) * (static_cast<float>(pi) * arriving.intensity);
    if (largest(returned) < negligibleLight) continue;
    const Ray shadowRay{lit.place, arriving.toLight, resolution_, time};
    const Vec3f passing = world_.geometry.lightPassing(shadowRay, arriving.distance);
    if (passing == Vec3f{}) continue;
    sum += returned * passing * gasTransmittance(shadowRay, arriving.distance, source);
  }
  return sum;
}

/// The gas' own absorption is in the intensity of a fire point already.
float Tracer::gasTransmittance(const Ray& ray, float distance, const LightSource& source) const {
  if (!world_.gas || source.kind == LightSource::Kind::fire) return 1;
  return world_.gas->roughTransmittance({ray.origin, ray.direction, ray.near, distance});
}

/// A surface of glass. Between touching pieces of one glass there is none: the ray goes on as if they were whole.
Vec3f Tracer::glassLight(const Travel& travel, const SurfaceHit& hit) const {
  const Material& material = world_.materials[hit.material].settings;
  const bool leaving = dot(travel.ray.direction, hit.normal) > 0;
  Vec3f light;
  if (world_.geometry.touchesSameGlass(travel.ray, hit)) {
    Travel onward = travel;
    onward.ray.near = hit.distance + resolution_;
    light = this->light(onward);
  } else {
    Vec3f normal = leaving ? -hit.shadingNormal : hit.shadingNormal;
    if (dot(normal, travel.ray.direction) >= 0) normal = leaving ? -hit.normal : hit.normal;
    light = beyondGlassSurface(travel, hit, normal);
  }
  return leaving ? light * beerTransmittance(material.absorption, hit.distance - travel.ray.near) : light;
}

/// `normal` faces the ray. Highlights of point lights and suns are added outside, as no ray would find those; fire is
/// found by the reflected ray.
Vec3f Tracer::beyondGlassSurface(const Travel& travel, const SurfaceHit& hit, const Vec3f& normal) const {
  const Material& material = world_.materials[hit.material].settings;
  const Vec3f& direction = travel.ray.direction;
  const bool leaving = dot(direction, hit.normal) > 0;
  const auto index = static_cast<float>(material.refractiveIndex);
  const float ratio = leaving ? index : 1 / index;
  const std::optional<Vec3f> through = refracted(direction, normal, ratio);
  const float mirrorShare = through ? fresnelReflectance(-dot(direction, normal), ratio) : 1;
  Vec3f light = next(travel, hit, reflected(direction, normal), mirrorShare) * mirrorShare;
  if (through) light += next(travel, hit, *through, 1 - mirrorShare) * (1 - mirrorShare);
  if (leaving || material.specular == Vec3f{}) return light;
  const Phong highlight{{}, material.specular, static_cast<float>(material.specularExponent)};
  const Axes axes(normal, {});
  const Vec3f place = travel.ray.origin + direction * hit.distance + normal * resolution_;
  return light + lit({highlight, axes, axes.toLocal(-direction), place}, travel.ray.time, false);
}

}  // namespace

Vec3f radiance(const RayWorld& world, const Ray& ray, float phase) { return Tracer(world).light({ray, phase, 0, 1}); }

}  // namespace brisance
