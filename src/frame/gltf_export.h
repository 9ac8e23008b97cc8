// Bodies at rest as one binary glTF: a named node per piece, materials by name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frame/frame.h"

namespace brisance {

std::string piecesToGlb(const std::vector<FrameBody>& bodies);
/// Reads what piecesToGlb wrote: name, mesh, material, pose, moves. Throws DamagedFile.
std::vector<FrameBody> piecesFromGlb(const std::string& bytes, const std::string& fileName);

}  // namespace brisance
