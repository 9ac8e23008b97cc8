// What the player needs to know of a scene's look, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "view/heat_scale.h"

namespace brisance {

/// Lights, surroundings, exposure, the gas' optics, and the colours of the heat scale.
nlohmann::json sceneToJson(const RenderSettings& settings, const HeatScale& scale);

/// The film's camera at a time [s] of film.
nlohmann::json cameraToJson(const CameraSettings& camera, double time);

}  // namespace brisance
