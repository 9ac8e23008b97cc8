// Meshes from files, and into them.
#pragma once

#include <filesystem>

#include "mesh/triangle_mesh.h"

namespace brisance {

/// OBJ, PLY, STL or glTF 2.0 (mesh_formats.h), by content where it tells and by extension otherwise. Throws DamagedFile
/// in one line for what is damaged or not accepted; InputError where there is no such file, or of no known format.
TriangleMesh readMesh(const std::filesystem::path& path);
/// Whether the name is that of a mesh file: .obj .ply .stl .gltf .glb in any case.
bool namesMeshFile(const std::filesystem::path& path);

/// By extension: .obj or .ply. Throws InputError for another.
void writeMesh(const std::filesystem::path& path, const TriangleMesh& mesh);

TriangleMesh readObj(const std::filesystem::path& path);
void writeObj(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace brisance
