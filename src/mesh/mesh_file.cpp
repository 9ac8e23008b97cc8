#include "mesh/mesh_file.h"

#include "base/check.h"
#include "base/durable_file.h"
#include "mesh/mesh_formats.h"

namespace brisance {
namespace {

namespace fs = std::filesystem;

std::string extensionOf(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

/// The bytes of a regular file: a pipe that nobody writes to would never end.
std::string bytesOf(const fs::path& path, const char* formats) {
  std::error_code trouble;
  if (!fs::exists(path, trouble))
    throw InputError(fmt::format("{}: does not exist, must be {} file", path.string(), formats));
  if (!fs::is_regular_file(path, trouble))
    throw InputError(fmt::format("{}: is no file, must be {} file", path.string(), formats));
  return readFile(path);
}

bool looksLikePly(std::string_view bytes) { return bytes.starts_with("ply\n") || bytes.starts_with("ply\r"); }
bool looksLikeGlb(std::string_view bytes) { return bytes.starts_with("glTF"); }

}  // namespace

bool namesMeshFile(const fs::path& path) {
  const std::string extension = extensionOf(path);
  for (const char* known : {".obj", ".ply", ".stl", ".gltf", ".glb"})
    if (extension == known) return true;
  return false;
}

TriangleMesh readMesh(const fs::path& path) {
  const std::string bytes = bytesOf(path, "an OBJ, PLY, STL or glTF"), file = path.string();
  const std::string extension = extensionOf(path);
  if (looksLikePly(bytes) || extension == ".ply") return plyFromBytes(bytes, file);
  if (looksLikeGlb(bytes) || extension == ".glb" || extension == ".gltf")
    return gltfFromBytes(bytes, file, path.has_parent_path() ? path.parent_path() : fs::path("."));
  if (extension == ".stl") return stlFromBytes(bytes, file);
  if (extension == ".obj") return objFromBytes(bytes, file);
  throw InputError(fmt::format("{}: is of no known format, must end in .obj, .ply, .stl, .gltf or .glb", file));
}

void writeMesh(const fs::path& path, const TriangleMesh& mesh) {
  const std::string extension = extensionOf(path);
  if (extension != ".obj" && extension != ".ply")
    throw InputError(fmt::format("{}: cannot be written in this format, must end in .obj or .ply", path.string()));
  writeDurably(path, extension == ".obj" ? objText(mesh) : plyBytes(mesh));
}

TriangleMesh readObj(const fs::path& path) { return objFromBytes(bytesOf(path, "an OBJ"), path.string()); }
void writeObj(const fs::path& path, const TriangleMesh& mesh) { writeDurably(path, objText(mesh)); }

}  // namespace brisance
