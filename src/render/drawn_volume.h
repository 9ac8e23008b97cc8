// What the picture draws of a frame's gas: its particles over a fine grid, or the cells of the gas itself.
#pragma once

#include "frame/frame.h"
#include "frame/particle_volume.h"
#include "render/blackbody.h"
#include "render/render_settings.h"

namespace brisance {

/// Fills `volume`, whose memory is used again, by the settings' source; false where there is nothing to draw.
bool drawnVolume(const Frame& frame, const VolumeSettings& settings, const BlackbodyColours& heat,
                 ParticleVolume& volume, SplatScratch& scratch);

}  // namespace brisance
