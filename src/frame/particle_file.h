// Particles as binary PLY: x y z [m], vx vy vz [m/s], mass [kg], temperature [K], kind; Blender and MeshLab open it.
#pragma once

#include <string>

#include "frame/frame.h"

namespace brisance {

std::string particlesToPly(const FrameParticles& particles);
/// Reads what particlesToPly made. Throws DamagedFile.
FrameParticles particlesFromPly(const std::string& bytes, const std::string& fileName);
/// Hash of the particles' values.
std::string contentHash(const FrameParticles& particles);

}  // namespace brisance
