#include <bit>

#include "base/check.h"
#include "mesh/mesh_formats.h"
#include "mesh/mesh_text.h"

namespace brisance {

static_assert(std::endian::native == std::endian::little, "PLY is written as memory holds it");

namespace {

void appendVertices(fmt::memory_buffer& text, const TriangleMesh& mesh) {
  const auto out = fmt::appender(text);
  for (const Vec3d& v : mesh.vertices) fmt::format_to(out, "v {} {} {}\n", v.x, v.y, v.z);
  for (const Vec2d& uv : mesh.uvs) fmt::format_to(out, "vt {} {}\n", uv.x, uv.y);
  for (const Vec3d& n : mesh.normals) fmt::format_to(out, "vn {} {} {}\n", n.x, n.y, n.z);
}

void appendCorner(fmt::memory_buffer& text, const TriangleMesh& mesh, std::uint32_t vertex) {
  const auto out = fmt::appender(text);
  const std::uint64_t n = std::uint64_t{vertex} + 1;
  if (mesh.normals.empty())
    mesh.uvs.empty() ? fmt::format_to(out, " {}", n) : fmt::format_to(out, " {}/{}", n, n);
  else
    mesh.uvs.empty() ? fmt::format_to(out, " {}//{}", n, n) : fmt::format_to(out, " {}/{}/{}", n, n, n);
}

void appendFaces(fmt::memory_buffer& text, const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!mesh.materials.empty() && (t == 0 || mesh.materials[t] != mesh.materials[t - 1]))
      fmt::format_to(fmt::appender(text), "usemtl {}\n", printable(mesh.materialNames.at(mesh.materials[t])));
    text.push_back('f');
    for (const std::uint32_t v : mesh.triangles[t]) appendCorner(text, mesh, v);
    text.push_back('\n');
  }
}

std::string plyHeader(const TriangleMesh& mesh) {
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& name : mesh.materialNames) header += fmt::format("comment material {}\n", printable(name));
  const auto addProperties = [&](std::initializer_list<const char*> names) {
    for (const char* name : names) header += fmt::format("property double {}\n", name);
  };
  header += fmt::format("element vertex {}\n", mesh.vertices.size());
  addProperties({"x", "y", "z"});
  if (!mesh.normals.empty()) addProperties({"nx", "ny", "nz"});
  if (!mesh.uvs.empty()) addProperties({"s", "t"});
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", mesh.triangles.size());
  if (!mesh.materials.empty()) header += "property ushort material_index\n";
  return header + "end_header\n";
}

template <class Value>
void put(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::string objText(const TriangleMesh& mesh) {
  fmt::memory_buffer text;
  appendVertices(text, mesh);
  appendFaces(text, mesh);
  return fmt::to_string(text);
}

std::string plyBytes(const TriangleMesh& mesh) {
  std::string bytes = plyHeader(mesh);
  constexpr std::uint8_t corners = 3;
  bytes.reserve(bytes.size() + mesh.vertices.size() * 2 * sizeof(Vec3d) + mesh.uvs.size() * sizeof(Vec2d) +
                mesh.triangles.size() * (sizeof(Triangle) + sizeof corners + sizeof(std::uint16_t)));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    put(bytes, mesh.vertices[v]);
    if (!mesh.normals.empty()) put(bytes, mesh.normals[v]);
    if (!mesh.uvs.empty()) put(bytes, mesh.uvs[v]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    put(bytes, corners);
    put(bytes, mesh.triangles[t]);
    if (!mesh.materials.empty()) put(bytes, mesh.materials[t]);
  }
  return bytes;
}

}  // namespace brisance
