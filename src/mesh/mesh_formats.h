// The formats of mesh files, on bytes. Readers never trust a count: what they allocate grows with the bytes at hand.
// `file` names the bytes in messages. Each throws DamagedFile with one line: "FILE:PLACE: what is wrong, what would be
// right". Triangles are kept as they are written, those that bound nothing too: mesh_repair.h judges them.
#pragma once

#include <filesystem>
#include <string_view>

#include "mesh/triangle_mesh.h"

namespace brisance {

/// Wavefront OBJ: v, vt, vn, f (any polygon, fanned; negative indices), usemtl as material names.
TriangleMesh objFromBytes(std::string_view bytes, const std::string& file);
/// Stanford PLY, ascii and binary of either byte order: elements `vertex` (x y z, nx ny nz, s t or u v or texture_u
/// texture_v) and `face` (vertex_indices or vertex_index, fanned; material_index into "comment material NAME" lines).
TriangleMesh plyFromBytes(std::string_view bytes, const std::string& file);
/// STL, ascii or binary: corners at exactly the same place become one vertex.
TriangleMesh stlFromBytes(std::string_view bytes, const std::string& file);
/// glTF 2.0, text or binary: the triangles of the default scene, moved by their nodes. Buffers that are files are
/// looked for in `folder` and nowhere else; an empty folder has none.
TriangleMesh gltfFromBytes(std::string_view bytes, const std::string& file, const std::filesystem::path& folder);

std::string objText(const TriangleMesh& mesh);
/// Binary little-endian PLY with double precision; materials as plyFromBytes reads them.
std::string plyBytes(const TriangleMesh& mesh);

}  // namespace brisance
