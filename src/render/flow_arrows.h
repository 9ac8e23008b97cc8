// The flow of the gas drawn as arrows (thesis Figure 5.1).
#pragma once

#include "frame/frame.h"
#include "render/render_settings.h"

namespace brisance {

/// Arrows, evenly spaced: each begins where it is, points the way the gas goes there, and is as long as gas
/// goes in settings.seconds. Gas that is slower than a hundredth of the fastest has none.
TriangleMesh flowArrows(const FrameGas& gas, const FlowSettings& settings);
/// Adds them, and what they are made of.
void addFlow(const FrameGas& gas, const FlowSettings& settings, std::vector<FrameBody>& bodies,
             std::map<std::string, Material>& materials);

}  // namespace brisance
