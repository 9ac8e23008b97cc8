#include "frame/piece_files.h"

#include <fmt/format.h>

#include <bit>
#include <functional>

namespace brisance {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written as it lies in memory");

/// Text gathered in large portions.
class TextWriter {
 public:
  explicit TextWriter(std::ostream& out) : out_(out) {}
  ~TextWriter() { flush(); }
  TextWriter(const TextWriter&) = delete;
  TextWriter& operator=(const TextWriter&) = delete;

  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(fmt::appender(text_), format, std::forward<Args>(args)...);
    text_.push_back('\n');
    constexpr std::size_t portion = 1 << 20;
    if (text_.size() > portion) flush();
  }

 private:
  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }
  std::ostream& out_;
  fmt::memory_buffer text_;
};

/// How many vertices, texture coordinates and normals earlier bodies have written: OBJ counts through the file, from 1.
struct ObjCounts {
  std::size_t vertices = 1, uvs = 1, normals = 1;
};

void writeObjTriangles(TextWriter& text, const FrameBody& body, const ObjCounts& first) {
  const TriangleMesh& mesh = *body.mesh;
  const auto corner = [&](std::uint32_t v) {
    const std::string uv = mesh.uvs.empty() ? "" : fmt::format("{}", first.uvs + v);
    if (mesh.normals.empty()) return fmt::format("{}{}{}", first.vertices + v, uv.empty() ? "" : "/", uv);
    return fmt::format("{}/{}/{}", first.vertices + v, uv, first.normals + v);
  };
  if (mesh.materials.empty() && !body.material.empty()) text.line("usemtl {}", body.material);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!mesh.materials.empty() && (t == 0 || mesh.materials[t] != mesh.materials[t - 1]))
      text.line("usemtl {}", mesh.materialNames.at(mesh.materials[t]));
    const auto& [a, b, c] = mesh.triangles[t];
    text.line("f {} {} {}", corner(a), corner(b), corner(c));
  }
}

void writeObjBody(TextWriter& text, const FrameBody& body, ObjCounts& counts) {
  const TriangleMesh& mesh = *body.mesh;
  text.line("o {}", body.name);
  for (const Vec3d& v : mesh.vertices) {
    const Vec3d place = body.pose * v;
    text.line("v {} {} {}", place.x, place.y, place.z);
  }
  for (const Vec2d& uv : mesh.uvs) text.line("vt {} {}", uv.x, uv.y);
  for (const Vec3d& n : mesh.normals) {
    const Vec3d turned = rotate(body.pose.orientation, n);
    text.line("vn {} {} {}", turned.x, turned.y, turned.z);
  }
  writeObjTriangles(text, body, counts);
  counts.vertices += mesh.vertices.size();
  counts.uvs += mesh.uvs.size();
  counts.normals += mesh.normals.size();
}

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
void put(std::string& bytes, const Vec3d& v) {
  for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<float>(v[axis]));
}

struct PlyLayout {
  bool normals = false, uvs = false;
  std::size_t vertices = 0, faces = 0;
};

PlyLayout layoutOf(const std::vector<FrameBody>& bodies) {
  PlyLayout layout;
  for (const FrameBody& body : bodies) {
    layout.normals = layout.normals || !body.mesh->normals.empty();
    layout.uvs = layout.uvs || !body.mesh->uvs.empty();
    layout.vertices += body.mesh->vertices.size();
    layout.faces += body.mesh->triangles.size();
  }
  return layout;
}

std::string plyHeader(const PlyLayout& layout) {
  std::string text = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", layout.vertices);
  for (const char* axis : {"x", "y", "z"}) text += fmt::format("property float {}\n", axis);
  if (layout.normals)
    for (const char* axis : {"nx", "ny", "nz"}) text += fmt::format("property float {}\n", axis);
  if (layout.uvs) text += "property float s\nproperty float t\n";
  return text +
         fmt::format("element face {}\nproperty list uchar uint vertex_indices\nproperty int piece\nend_header\n",
                     layout.faces);
}

std::string plyVertices(const FrameBody& body, const PlyLayout& layout) {
  const TriangleMesh& mesh = *body.mesh;
  std::string bytes;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    put(bytes, body.pose * mesh.vertices[v]);
    if (layout.normals) put(bytes, mesh.normals.empty() ? Vec3d{} : rotate(body.pose.orientation, mesh.normals[v]));
    if (!layout.uvs) continue;
    const Vec2d uv = mesh.uvs.empty() ? Vec2d{} : mesh.uvs[v];
    put(bytes, static_cast<float>(uv.x));
    put(bytes, static_cast<float>(uv.y));
  }
  return bytes;
}

}  // namespace

void writeObjBodies(std::ostream& out, const std::vector<FrameBody>& bodies) {
  TextWriter text(out);
  ObjCounts counts;
  for (const FrameBody& body : bodies) writeObjBody(text, body, counts);
}

void writePlyBodies(std::ostream& out, const std::vector<FrameBody>& bodies) {
  const PlyLayout layout = layoutOf(bodies);
  out << plyHeader(layout);
  for (const FrameBody& body : bodies) out << plyVertices(body, layout);
  std::uint32_t first = 0;
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    std::string bytes;
    for (const Triangle& triangle : bodies[n].mesh->triangles) {
      put(bytes, static_cast<std::uint8_t>(triangle.size()));
      for (const std::uint32_t v : triangle) put(bytes, first + v);
      put(bytes, static_cast<std::int32_t>(n));
    }
    out << bytes;
    first += static_cast<std::uint32_t>(bodies[n].mesh->vertices.size());
  }
}

}  // namespace brisance
