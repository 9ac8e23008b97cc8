#include "render/first_sight.h"

#include <algorithm>
#include <limits>

#include "render/dielectric.h"

namespace brisance {
namespace {

float largest(const Vec3f& colour) { return std::max({colour.x, colour.y, colour.z}); }

/// The way behind the surfaces met so far.
class SightWalk {
 public:
  SightWalk(const SightWorld& world, const Ray& ray, float phase) : world_(world), ray_(ray), phase_(phase) {}

  Sight follow() {
    while (meetNext()) {
    }
    sight_.clearness = largest(throughput_);
    return sight_;
  }

 private:
  bool meetNext();
  bool crossGas(float far);
  void lookAtSky();
  bool meetGlass(const SurfaceHit& hit);
  bool meetOpaque(const SurfaceHit& hit);
  void pass(const SurfaceHit& hit, const Vec3f& side, const Vec3f& direction);
  void loseCertainty();
  Vec3f facing(const SurfaceHit& hit) const;

  const SightWorld& world_;
  Ray ray_;
  float phase_;
  Sight sight_;
  Vec3f throughput_{1, 1, 1};
  bool first_ = true, certain_ = true;  // certain: all samples of the ray come this way
  int mirrors_ = 0, splits_ = 0;
  float before_ = 0;  // [m] to the origin of the ray
};

bool SightWalk::meetNext() {
  SurfaceHit hit;
  const bool found = world_.geometry.closest(ray_, hit);
  const bool passes = crossGas(found ? hit.distance : std::numeric_limits<float>::max());
  if (first_ && found) {
    sight_.found = true;
    sight_.first = hit;
  }
  first_ = false;
  if (!passes) return false;
  if (!found) {
    lookAtSky();
    return false;
  }
  sight_.length = before_ + hit.distance;
  return world_.materials[hit.material].settings.glass ? meetGlass(hit) : meetOpaque(hit);
}

bool SightWalk::crossGas(float far) {
  if (!world_.gas) return true;
  const GasPassage passage = world_.gas->march({ray_.origin, ray_.direction, ray_.near, far, phase_});
  if (first_) {
    sight_.gasLight = passage.light;
    sight_.gasTransmittance = passage.transmittance;
  }
  if (certain_) sight_.certain += throughput_ * passage.light;
  sight_.albedo += throughput_ * world_.smokeAlbedo * (1 - passage.transmittance);
  throughput_ *= passage.transmittance;
  return passage.transmittance > 0;
}

void SightWalk::lookAtSky() {
  if (!certain_) return;
  Vec3f light = world_.environment(ray_.direction);
  for (const LightSource& source : world_.lights) light += source.discSeenAlong(ray_.direction);
  sight_.certain += throughput_ * light;
}

/// The normal between the vertices on the ray's side, or the triangle's where that is none.
Vec3f SightWalk::facing(const SurfaceHit& hit) const {
  const Vec3f face = dot(ray_.direction, hit.normal) > 0 ? -hit.normal : hit.normal;
  const Vec3f normal = dot(hit.shadingNormal, face) < 0 ? -hit.shadingNormal : hit.shadingNormal;
  return dot(normal, ray_.direction) >= 0 ? face : normal;
}

/// From here on the integrator draws one of two ways.
void SightWalk::loseCertainty() {
  if (++splits_ > world_.settings.splits) certain_ = false;
}

void SightWalk::pass(const SurfaceHit& hit, const Vec3f& side, const Vec3f& direction) {
  before_ += hit.distance;
  ray_.origin = ray_.origin + ray_.direction * hit.distance + side;
  ray_.direction = direction;
  ray_.near = world_.geometry.resolution();
  ++mirrors_;
  if (largest(throughput_) < world_.settings.faint) certain_ = false;
}

bool SightWalk::meetGlass(const SurfaceHit& hit) {
  const SurfaceMaterial& material = world_.materials[hit.material];
  const bool leaving = dot(ray_.direction, hit.normal) > 0;
  if (leaving) throughput_ = throughput_ * beerTransmittance(material.settings.absorption, hit.distance - ray_.near);
  if (world_.geometry.touchesSameGlass(ray_, hit)) {
    ray_.near = hit.distance + world_.geometry.resolution();
    return true;
  }
  const SurfaceScattering glass = material.glass(leaving);
  const auto* smooth = std::get_if<SmoothDielectric>(&glass);
  const Vec3f normal = facing(hit);
  sight_.normal = normal;
  sight_.ends = true;
  if (!smooth || mirrors_ >= world_.maxDepth) {
    sight_.albedo += throughput_;
    return false;
  }
  const std::optional<Vec3f> through = refracted(ray_.direction, normal, smooth->ratio);
  if (through) {
    throughput_ *= 1 - fresnelReflectance(-dot(ray_.direction, normal), smooth->ratio);
    loseCertainty();
  }
  sight_.ends = false;
  pass(hit, {}, through ? *through : reflected(ray_.direction, normal));
  return true;
}

bool SightWalk::meetOpaque(const SurfaceHit& hit) {
  const SurfaceMaterial& material = world_.materials[hit.material];
  const Vec3f colour = material.diffuseColour(hit.texture), normal = facing(hit);
  const Vec3f mirror = material.settings.reflection;
  if (certain_) sight_.certain += throughput_ * (colour * material.settings.emission);
  const Vec3f returned = colour * static_cast<float>(material.settings.diffuseWeight) + material.settings.specular;
  sight_.albedo += throughput_ * returned;
  sight_.normal = normal;
  if (largest(mirror) <= largest(returned) || mirrors_ >= world_.maxDepth) {
    sight_.ends = true;
    return false;
  }
  throughput_ = throughput_ * mirror;
  loseCertainty();
  const Vec3f face = dot(ray_.direction, hit.normal) > 0 ? -hit.normal : hit.normal;
  Vec3f mirrored = reflected(ray_.direction, normal);
  if (dot(mirrored, face) <= 0) mirrored = reflected(ray_.direction, face);
  pass(hit, face * world_.geometry.resolution(), mirrored);
  return true;
}

}  // namespace

Sight firstSight(const SightWorld& world, const Ray& ray, float phase) { return SightWalk(world, ray, phase).follow(); }

}  // namespace brisance
