// Bodies as one binary glTF: a named node per piece; at rest, or moving through a film.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "frame/run_motion.h"
#include "frame/surface_look.h"

namespace brisance {

/// Materials are names alone.
std::string piecesToGlb(const std::vector<FrameBody>& bodies);
/// Reads what piecesToGlb wrote: name, mesh, material, pose, moves. Throws DamagedFile.
std::vector<FrameBody> piecesFromGlb(const std::string& bytes, const std::string& fileName);

/// The bodies of a film of `fps` frames a second: frame N at (N - 1) / fps seconds. A track of positions and one of
/// rotations for each body that changes them (neededKeys says which keys they have); materials by their looks, pictures
/// inside the file.
std::string motionToGlb(const RunMotion& motion, double fps, const SurfaceLooks& looks);

}  // namespace brisance
