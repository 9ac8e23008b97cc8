// The volume of a picture straight from the gas of a frame: its soot and flame, coloured by its heat.
#pragma once

#include "frame/frame.h"
#include "frame/particle_volume.h"
#include "render/blackbody.h"
#include "render/render_settings.h"

namespace brisance {

/// Whether there is any to draw.
bool hasGas(const FrameGas& gas);
/// Density is soot plus `fuelWeight` times flame, colour that of the temperature, on the cells of the gas: those of
/// the bricks that hold either, and a border of empty ones. The memory of `volume` is used again.
void gasVolume(const FrameGas& gas, const VolumeSettings& settings, const BlackbodyColours& heat,
               ParticleVolume& volume);

}  // namespace brisance
