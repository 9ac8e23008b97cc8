#include "render/lights.h"

#include <algorithm>
#include <cmath>

#include "render/scattering.h"

namespace brisance {
namespace {

void addSources(const PointLight& light, const GasMedium*, std::vector<LightSource>& sources) {
  sources.push_back(
      {LightSource::Kind::point, Vec3f(light.position), light.intensity, static_cast<float>(light.falloff)});
}

void addSources(const SunLight& light, const GasMedium*, std::vector<LightSource>& sources) {
  sources.push_back({LightSource::Kind::sun, Vec3f(-normalized(light.direction)), light.radiance, 0, 0,
                     static_cast<float>(std::cos(light.angleDegrees * pi / 360))});
}

void addSources(const FireLight& light, const GasMedium* gas, std::vector<LightSource>& sources) {
  if (!gas) return;
  const auto scale = static_cast<float>(light.strength / pi);
  for (const FirePoint& point : findFirePoints(*gas, light.lights))
    sources.push_back({LightSource::Kind::fire, point.position, point.intensity * scale, 2, point.radius});
}

}  // namespace

ArrivingLight LightSource::at(const Vec3f& from) const {
  if (kind == Kind::sun) return {place, std::numeric_limits<float>::infinity(), intensity};
  const Vec3f way = place - from;
  const float distance = length(way);
  const float softened = std::sqrt(distance * distance + radius * radius);
  const float fall = falloff == 2 ? 1 / (softened * softened) : std::pow(softened, -falloff);
  return {normalized(way), distance, intensity * fall};
}

ArrivingLight LightSource::at(const Vec3f& from, const Vec2<float>& where) const {
  ArrivingLight light = at(from);
  if (cosine >= 1) return light;
  const float z = 1 - where.x * (1 - cosine), sine = std::sqrt(std::max(0.0f, 1 - z * z));
  const float around = 2 * static_cast<float>(pi) * where.y;
  light.toLight = Axes(light.toLight, {}).toWorld({sine * std::cos(around), sine * std::sin(around), z});
  return light;
}

Vec3f LightSource::discSeenAlong(const Vec3f& direction) const {
  if (kind != Kind::sun || cosine >= 1 || dot(direction, place) < cosine) return {};
  return intensity / (2 * (1 - cosine));
}

std::vector<LightSource> lightSources(const std::vector<Light>& lights, const GasMedium* gas) {
  std::vector<LightSource> sources;
  for (const Light& light : lights) std::visit([&](const auto& kind) { addSources(kind, gas, sources); }, light);
  return sources;
}

}  // namespace brisance
