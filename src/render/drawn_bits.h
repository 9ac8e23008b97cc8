// Sparks and dust as things that rays meet.
#pragma once

#include "frame/frame.h"
#include "render/blackbody.h"
#include "render/render_settings.h"

namespace brisance {

/// Streaks of light, one body per step of temperature, each as long as its spark goes in settings.sparkSeconds; and
/// grains that mirror and scatter, one triangle each, turned another way in every frame. Adds them, and what they are
/// made of. Sparks that are too cold to be seen are left out.
void addBits(const Frame& frame, const BitsLook& settings, const BlackbodyColours& heat, std::vector<FrameBody>& bodies,
             std::map<std::string, Material>& materials);

}  // namespace brisance
