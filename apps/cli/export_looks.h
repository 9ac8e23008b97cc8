// A scene's materials as exported files show them.
#pragma once

#include "frame/surface_look.h"
#include "render/render_settings.h"

namespace brisance {

SurfaceLooks looksOf(const RenderSettings& settings);

}  // namespace brisance
