// Materials that look different on each piece: tinted apart, or shining by the piece's temperature.
#pragma once

#include "frame/frame.h"
#include "render/blackbody.h"
#include "render/render_settings.h"

namespace brisance {

/// Gives bodies of a frame materials of their own where theirs asks for it, and adds these to the materials. Solid
/// colours are tinted, pictures and patterns keep theirs. `heat`: the colour of a temperature.
void paintPieces(std::vector<FrameBody>& bodies, std::map<std::string, Material>& materials,
                 const BlackbodyColours& heat);

}  // namespace brisance
