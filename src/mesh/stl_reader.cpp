#include <cstring>

#include "mesh/mesh_formats.h"
#include "mesh/mesh_text.h"
#include "mesh/number_table.h"

namespace brisance {
namespace {

constexpr std::size_t titleBytes = 80, headerBytes = titleBytes + sizeof(std::uint32_t);
constexpr std::size_t normalBytes = 3 * sizeof(float), facetBytes = 4 * normalBytes + sizeof(std::uint16_t);

/// Makes one vertex of all corners at a place.
class Welder {
 public:
  explicit Welder(std::size_t corners) : table_(corners / 6) {}  // a closed surface has half as many vertices as faces

  std::uint32_t vertexAt(const Vec3d& p) {
    const auto fresh = static_cast<std::uint32_t>(mesh.vertices.size());
    const std::uint32_t v =
        table_.findOrAdd(hashOf(p), fresh, [&](std::uint32_t other) { return mesh.vertices[other] == p; });
    if (v == fresh) mesh.vertices.push_back(p);
    return v;
  }

  TriangleMesh mesh;

 private:
  NumberTable table_;
};

std::size_t promisedFacets(std::string_view bytes) {
  std::uint32_t count;
  std::memcpy(&count, bytes.data() + titleBytes, sizeof count);
  return count;
}

/// Binary files may begin with "solid" too: then the length tells.
bool isBinary(std::string_view bytes) {
  if (bytes.size() >= headerBytes && bytes.size() == headerBytes + promisedFacets(bytes) * facetBytes) return true;
  return !trimmed(bytes.substr(0, titleBytes)).starts_with("solid");
}

TriangleMesh readBinary(std::string_view bytes, const std::string& file) {
  if (bytes.size() < headerBytes)
    throw DamagedFile(fmt::format("{}:byte {}: ends early, must be STL: a header of {} bytes, or the word 'solid'",
                                  file, bytes.size(), headerBytes));
  const std::size_t count = promisedFacets(bytes), room = (bytes.size() - headerBytes) / facetBytes;
  if (count > room)
    throw DamagedFile(fmt::format("{}:byte {}: promises {} triangles, must be at most {} in a file of this size", file,
                                  titleBytes, count, room));
  Welder welder(3 * count);
  welder.mesh.triangles.reserve(count);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t at = headerBytes + n * facetBytes + normalBytes;
    float corners[9];
    std::memcpy(corners, bytes.data() + at, sizeof corners);
    Triangle t;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3d p(Vec3f{corners[3 * c], corners[3 * c + 1], corners[3 * c + 2]});
      if (!isFinite(p))
        throw DamagedFile(
            fmt::format("{}:byte {}: triangle {}: a corner that is not finite, must be", file, at, n + 1));
      t[c] = welder.vertexAt(p);
    }
    welder.mesh.triangles.push_back(t);
  }
  return std::move(welder.mesh);
}

/// Only 'vertex' lines count, three to a facet; names of solids and normals are passed over.
class AsciiReader {
 public:
  AsciiReader(std::string_view text, const std::string& file) : rest_(text), place_{file}, welder_(0) {}

  TriangleMesh read() {
    while (!rest_.empty()) {
      ++place_.line;
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      readLine(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
    }
    if (inFacet_) place_.fail("ends within a facet, must end with 'endsolid'");
    return std::move(welder_.mesh);
  }

 private:
  void readLine(std::string_view line) {
    const std::string_view keyword = nextWord(line);
    if (keyword == "vertex") return readVertex(line);
    if (keyword == "facet") return openFacet();
    if (keyword == "endfacet") return closeFacet();
    for (const char* known : {"", "solid", "endsolid", "outer", "endloop"})
      if (keyword == known) return;
    place_.fail(
        fmt::format("'{}': must be solid, facet, outer loop, vertex, endloop, endfacet or endsolid", shown(keyword)));
  }

  void openFacet() {
    if (inFacet_) place_.fail("a facet within a facet, must come after 'endfacet'");
    inFacet_ = true;
    corners_ = 0;
  }

  void readVertex(std::string_view line) {
    if (!inFacet_ || corners_ == 3) place_.fail("a vertex too many, must be three in each facet");
    Vec3d p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = parseReal(nextWord(line), place_);
    triangle_[corners_++] = welder_.vertexAt(p);
  }

  void closeFacet() {
    if (!inFacet_ || corners_ != 3)
      place_.fail(fmt::format("a facet of {} vertices, must be three", inFacet_ ? corners_ : 0));
    inFacet_ = false;
    welder_.mesh.triangles.push_back(triangle_);
  }

  std::string_view rest_;
  LinePlace place_;
  Welder welder_;
  Triangle triangle_{};
  std::size_t corners_ = 0;
  bool inFacet_ = false;
};

}  // namespace

TriangleMesh stlFromBytes(std::string_view bytes, const std::string& file) {
  TriangleMesh mesh = isBinary(bytes) ? readBinary(bytes, file) : AsciiReader(bytes, file).read();
  if (mesh.triangles.empty()) throw DamagedFile(file + ": no facet, must hold at least one");
  return mesh;
}

}  // namespace brisance
