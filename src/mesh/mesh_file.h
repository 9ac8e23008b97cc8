// Meshes from files.
#pragma once

#include <filesystem>

#include "mesh/triangle_mesh.h"

namespace brisance {

/// Wavefront OBJ: v, vt, vn, f (any polygon, fanned; negative indices), usemtl as material names. Vertices are split
/// only where a position is used with several vt/vn. Throws DamagedFile("PATH:LINE: what is wrong, what would be
/// right") for a bad index, a number that is not finite, a face of fewer than three corners, no face at all; InputError
/// when the file does not exist.
TriangleMesh readObj(const std::filesystem::path& path);
void writeObj(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace brisance
