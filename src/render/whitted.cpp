#include "render/whitted.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <type_traits>

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
  float time;
  bool byFire;    ///< whether fire is among its lights
  Vec3f light{};  ///< that it returns
};

class Tracer {
 public:
  explicit Tracer(const RayWorld& world) : world_(world), resolution_(world.geometry.resolution()) {}
  Vec3f light(const Travel& travel) const;
  /// Of up to `room` rays, `found` what each of them meets.
  template <int room>
  void light(std::span<const Travel> travels, std::span<const FoundTriangle> found, std::span<Vec3f> light) const;

 private:
  template <int room>
  void throughGas(std::span<const Travel> travels, std::span<const FoundTriangle> found, GasPassage* passages) const;
  bool isGlass(const SurfaceHit& hit) const { return world_.materials[hit.material].settings.glass; }
  LitPlace opaquePlace(const Travel& travel, const SurfaceHit& hit) const;
  Vec3f opaqueLight(const Travel& travel, const SurfaceHit& hit, const Vec3f& lit) const;
  Vec3f glassLight(const Travel& travel, const SurfaceHit& hit) const;
  Vec3f beyondGlassSurface(const Travel& travel, const SurfaceHit& hit, const Vec3f& normal) const;
  template <int room>
  void shine(std::span<LitPlace> places) const;
  template <int room>
  void shine(const LightSource& source, std::span<LitPlace> places) const;
  Vec3f next(const Travel& travel, const SurfaceHit& hit, const Vec3f& direction, float share) const;
  float gasTransmittance(const Ray& ray, float distance, const LightSource& light) const;

  const RayWorld& world_;
  float resolution_;
};

Vec3f Tracer::light(const Travel& travel) const {
  const FoundTriangle found = world_.geometry.find(travel.ray);
  Vec3f sum;
  light<1>({&travel, 1}, {&found, 1}, {&sum, 1});
  return sum;
}

template <int room>
void Tracer::throughGas(std::span<const Travel> travels, std::span<const FoundTriangle> found,
                        GasPassage* passages) const {
  if (!world_.gas) return;
  GasPath paths[room];
  for (std::size_t n = 0; n < travels.size(); ++n) {
    const Ray& ray = travels[n].ray;
    const float far = found[n].isNone() ? std::numeric_limits<float>::max() : found[n].distance;
    paths[n] = {ray.origin, ray.direction, ray.near, far, travels[n].phase};
  }
  if (travels.size() == 1) return void(*passages = world_.gas->march(paths[0]));
  world_.gas->march({paths, travels.size()}, {passages, travels.size()});
}

/// A ray that has come to a surface.
struct Arrived {
  std::size_t ray;
  Travel travel;
  float transmittance;  ///< of the gas before it
  SurfaceHit hit;
};

/// Values whose number is known at run time, without memory from the heap.
template <class T, int room>
class Some {
 public:
  void push_back(const T& value) { new (&at(count_++)) T(value); }
  std::span<T> all() { return {&at(0), static_cast<std::size_t>(count_)}; }

 private:
  T& at(int n) { return *std::launder(reinterpret_cast<T*>(room_) + n); }
  alignas(T) std::byte room_[room * sizeof(T)];
  int count_ = 0;
  static_assert(std::is_trivially_destructible_v<T>);
};

/// Gas up to the first surface, then what that surface returns: so fire and glass cover one another rightly at any
/// depth. The shadow rays of all rays that come to opaque surfaces go together.
template <int room>
void Tracer::light(std::span<const Travel> travels, std::span<const FoundTriangle> found,
                   std::span<Vec3f> light) const {
  Some<Arrived, room> arrived;
  Some<LitPlace, room> places;
  GasPassage passages[room];
  throughGas<room>(travels, found, passages);
  for (std::size_t n = 0; n < travels.size(); ++n) {
    const GasPassage& gas = passages[n];
    light[n] = gas.light;
    if (gas.transmittance == 0) continue;
    if (found[n].isNone()) {
      light[n] += world_.background(travels[n].ray.direction) * gas.transmittance;
      continue;
    }
    Arrived at{n, travels[n], gas.transmittance, world_.geometry.surfaceAt(found[n])};
    at.travel.share *= gas.transmittance;
    arrived.push_back(at);
    if (!isGlass(at.hit)) places.push_back(opaquePlace(at.travel, at.hit));
  }
  shine<room>(places.all());
  const LitPlace* lit = places.all().data();
  for (const Arrived& at : arrived.all()) {
    const Vec3f returned =
        isGlass(at.hit) ? glassLight(at.travel, at.hit) : opaqueLight(at.travel, at.hit, (lit++)->light);
    light[at.ray] += returned * at.transmittance;
  }
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
LitPlace Tracer::opaquePlace(const Travel& travel, const SurfaceHit& hit) const {
  const Vec3f& direction = travel.ray.direction;
  const Vec3f face = dot(direction, hit.normal) > 0 ? -hit.normal : hit.normal;
  const Vec3f normal = dot(hit.shadingNormal, face) < 0 ? -hit.shadingNormal : hit.shadingNormal;
  const Vec3f place = travel.ray.origin + direction * hit.distance + face * resolution_;
  const Axes axes(normal, hit.alongU);
  return {
      world_.materials[hit.material].opaque(hit.texture), axes, axes.toLocal(-direction), place, travel.ray.time, true};
}

/// `lit`: what the surface returns of the direct lights.
Vec3f Tracer::opaqueLight(const Travel& travel, const SurfaceHit& hit, const Vec3f& lit) const {
  const SurfaceMaterial& material = world_.materials[hit.material];
  const Vec3f light = lit + material.diffuseColour(hit.texture) *
                                (material.settings.ambient * world_.ambientLight + material.settings.emission);
  const Vec3f& mirror = material.settings.reflection;
  if (mirror == Vec3f{}) return light;
  const Vec3f& direction = travel.ray.direction;
  const Vec3f face = dot(direction, hit.normal) > 0 ? -hit.normal : hit.normal;
  Vec3f mirrored = reflected(direction, hit.shadingNormal);
  if (dot(mirrored, face) <= 0) mirrored = reflected(direction, face);  // a smooth normal bent it into the surface
  return light + mirror * next(travel, hit, mirrored, largest(mirror));
}

template <int room>
void Tracer::shine(std::span<LitPlace> places) const {
  for (const LightSource& source : world_.lights) shine<room>(source, places);
}

/// The direct light of one source. I_s is what a white diffuse surface returns: irradiance over pi.
template <int room>
void Tracer::shine(const LightSource& source, std::span<LitPlace> places) const {
  Some<Ray, room> rays;
  Some<float, room> distances;
  Some<LitPlace*, room> lit;
  Some<Vec3f, room> returned;
  for (LitPlace& place : places) {
    if (source.kind == LightSource::Kind::fire && !place.byFire) continue;
    const ArrivingLight arriving = source.at(place.place);
    const Vec3f light = value(place.surface, place.out, place.axes.toLocal(arriving.toLight)) *
                        (static_cast<float>(pi) * arriving.intensity);
    if (largest(light) < negligibleLight) continue;
    rays.push_back({place.place, arriving.toLight, resolution_, place.time});
    distances.push_back(arriving.distance);
    lit.push_back(&place);
    returned.push_back(light);
  }
  Vec3f passing[room];
  const std::size_t count = rays.all().size();
  if (count == 1) passing[0] = world_.geometry.lightPassing(rays.all()[0], distances.all()[0]);
  if (count > 1) world_.geometry.lightPassing(rays.all(), distances.all(), passing);
  for (std::size_t n = 0; n < count; ++n)
    if (passing[n] != Vec3f{})
      lit.all()[n]->light +=
          returned.all()[n] * passing[n] * gasTransmittance(rays.all()[n], distances.all()[n], source);
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
  LitPlace lit{highlight, axes, axes.toLocal(-direction), place, travel.ray.time, false};
  shine<1>({&lit, 1});
  return light + lit.light;
}

}  // namespace

Vec3f radiance(const RayWorld& world, const Ray& ray, float phase) { return Tracer(world).light({ray, phase, 0, 1}); }

void radiance(const RayWorld& world, std::span<const CameraRay> rays, std::span<Vec3f> light) {
  Ray ways[SceneGeometry::packet];
  Travel travels[SceneGeometry::packet];
  FoundTriangle found[SceneGeometry::packet];
  for (std::size_t n = 0; n < rays.size(); ++n) {
    ways[n] = rays[n].ray;
    travels[n] = {rays[n].ray, rays[n].phase, 0, 1};
  }
  world.geometry.find({ways, rays.size()}, found);
  Tracer(world).light<SceneGeometry::packet>({travels, rays.size()}, found, light);
}

}  // namespace brisance
