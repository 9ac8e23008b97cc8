#include "view/scene_json.h"

#include <nlohmann/json.hpp>

#include "render/camera.h"

namespace brisance {

using nlohmann::json;

namespace {

template <class T>
json asJson(const Vec3<T>& v) {
  return {v.x, v.y, v.z};
}

json asJson(const PointLight& light) {
  return {{"type", "point"},
          {"position", asJson(light.position)},
          {"intensity", asJson(light.intensity)},
          {"falloff", light.falloff}};
}
json asJson(const SunLight& light) {
  return {{"type", "sun"}, {"direction", asJson(light.direction)}, {"radiance", asJson(light.radiance)}};
}
json asJson(const FireLight& light) { return {{"type", "fire"}, {"strength", light.strength}}; }

json opticsOf(const VolumeSettings& volume) {
  return {{"drawn", volume.drawn},
          {"opacity", volume.opacity},
          {"minDensity", volume.minDensity},
          {"maxDensity", volume.maxDensity},
          {"emission", volume.emission},
          {"smokeColour", asJson(volume.smokeColour)},
          {"blur", volume.blur}};
}

}  // namespace

json sceneToJson(const RenderSettings& settings, const HeatScale& scale) {
  json told = {{"background", asJson(settings.background)},
               {"ambient", asJson(settings.ambientLight)},
               {"exposureStops", settings.exposureStops},
               {"gas", opticsOf(settings.volume)},
               {"lights", json::array()}};
  for (const Light& light : settings.lights)
    told["lights"].push_back(std::visit([](const auto& kind) { return asJson(kind); }, light));
  told["heat"] = {{"coldest", HeatScale::coldest}, {"hottest", HeatScale::hottest}, {"colours", json::array()}};
  for (const Vec3f& colour : scale.colours()) told["heat"]["colours"].push_back(asJson(colour));
  return told;
}

json cameraToJson(const CameraSettings& camera, double time) {
  const CameraKey key = cameraAt(camera, time);
  return {{"position", asJson(key.position)},
          {"lookAt", asJson(key.lookAt)},
          {"up", asJson(key.up)},
          {"fov", key.fovDegrees}};
}

}  // namespace brisance
