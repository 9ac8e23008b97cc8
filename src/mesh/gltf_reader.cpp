#include <limits>
#include <tuple>

#include "base/check.h"
#include "mesh/corner_mesh.h"
#include "mesh/gltf_document.h"
#include "mesh/mesh_formats.h"
#include "mesh/mesh_text.h"

namespace brisance {
namespace {

using Json = GltfDocument::Json;

/// Vertices and indices that a scene may hold beside those for which the file has bytes: copies of a mesh by nodes.
constexpr std::size_t copiesAllowed = 1'000'000;

enum class Mode { triangles = 4, strip = 5, fan = 6 };

struct Affine {
  Mat3 linear;
  Vec3d offset;
  friend Affine operator*(const Affine& a, const Affine& b) {
    return {a.linear * b.linear, a.linear * b.offset + a.offset};
  }
};

/// Carries normals, up to their length: the matrix of cofactors also exists where there is no inverse.
Mat3 cofactors(const Mat3& m) {
  return {{cross(m.row[1], m.row[2]), cross(m.row[2], m.row[0]), cross(m.row[0], m.row[1])}};
}

class GltfReader {
 public:
  explicit GltfReader(GltfDocument& document) : document_(document), root_(document.root()) {}

  TriangleMesh read() {
    demandKnownExtensions();
    for (const auto& [mesh, place] : instances()) addMesh(mesh, place);
    if (mesh_.triangles.empty()) document_.fail("meshes", "no triangle in the scene, must hold at least one");
    finish();
    return std::move(mesh_);
  }

 private:
  struct Instance {
    std::size_t mesh = 0;
    Affine place;
  };

  /// Those that only change how a surface looks do not matter here; others change what it is.
  void demandKnownExtensions() const {
    for (const Json& extension : document_.list("extensionsRequired")) {
      const std::string name = extension.is_string() ? extension.get<std::string>() : "";
      bool known = false;
      for (const char* lead : {"KHR_materials_", "KHR_texture_", "KHR_lights_", "EXT_texture_", "EXT_lights_"})
        known = known || name.starts_with(lead);
      if (!known)
        document_.fail("extensionsRequired", fmt::format("'{}' is not read, must be stored without it", shown(name)));
    }
  }

  std::vector<std::size_t> numbers(const Json& object, const char* name) const {
    std::vector<std::size_t> result;
    const auto found = object.find(name);
    if (found == object.end()) return result;
    if (!found->is_array()) document_.fail(name, "is no list, must be");
    for (const Json& value : *found) {
      if (!value.is_number_unsigned()) document_.fail(name, "holds no whole number from 0, must");
      result.push_back(value.get<std::size_t>());
    }
    return result;
  }

  /// Of the default scene, else the first; without scenes those that are nobody's child.
  std::vector<std::size_t> rootNodes() const {
    if (!document_.list("scenes").empty())
      return numbers(document_.entry("scenes", document_.number(root_, "scene").value_or(0)), "nodes");
    std::vector<bool> isChild(document_.list("nodes").size());
    for (std::size_t n = 0; n < isChild.size(); ++n)
      for (const std::size_t child : numbers(document_.entry("nodes", n), "children"))
        if (child < isChild.size()) isChild[child] = true;
    std::vector<std::size_t> roots;
    for (std::size_t n = 0; n < isChild.size(); ++n)
      if (!isChild[n]) roots.push_back(n);
    return roots;
  }

  /// A file of meshes without nodes holds each mesh once.
  std::vector<Instance> instances() const {
    std::vector<Instance> result;
    if (document_.list("nodes").empty())
      for (std::size_t m = 0; m < document_.list("meshes").size(); ++m) result.push_back({m, {}});
    std::vector<bool> seen(document_.list("nodes").size());
    std::vector<std::pair<std::size_t, Affine>> open;
    for (const std::size_t n : rootNodes()) open.push_back({n, {}});
    std::reverse(open.begin(), open.end());
    while (!open.empty()) {
      const auto [n, parent] = open.back();
      open.pop_back();
      const Json& node = document_.entry("nodes", n);
      if (seen[n]) document_.fail(fmt::format("nodes {}", n), "has two parents, must have one");
      seen[n] = true;
      const Affine place = parent * placeOf(node, n);
      if (const auto mesh = document_.number(node, "mesh")) result.push_back({*mesh, place});
      std::vector<std::size_t> children = numbers(node, "children");
      for (auto child = children.rbegin(); child != children.rend(); ++child) open.push_back({*child, place});
    }
    return result;
  }

  template <std::size_t N>
  std::array<double, N> numbersOf(const Json& node, const char* name, std::array<double, N> values,
                                  std::size_t n) const {
    const auto found = node.find(name);
    if (found == node.end()) return values;
    bool good = found->is_array() && found->size() == N;
    for (std::size_t i = 0; good && i < N; ++i) {
      good = (*found)[i].is_number();
      if (good) values[i] = (*found)[i].template get<double>();
    }
    if (!good) document_.fail(fmt::format("nodes {}", n), fmt::format("{}: must be {} numbers", name, N));
    return values;
  }

  Affine placeOf(const Json& node, std::size_t n) const {
    if (node.contains("matrix")) {
      const auto m = numbersOf<16>(node, "matrix", {}, n);  // by columns
      return {{{{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}}}, {m[12], m[13], m[14]}};
    }
    const auto t = numbersOf<3>(node, "translation", {0, 0, 0}, n);
    const auto r = numbersOf<4>(node, "rotation", {0, 0, 0, 1}, n);
    const auto s = numbersOf<3>(node, "scale", {1, 1, 1}, n);
    Mat3 linear = rotationMatrix(Quaternion{r[3], r[0], r[1], r[2]});
    for (Vec3d& row : linear.row) row = row * Vec3d{s[0], s[1], s[2]};
    return {linear, {t[0], t[1], t[2]}};
  }

  void addMesh(std::size_t number, const Affine& place) {
    const Json& mesh = document_.entry("meshes", number);
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array())
      document_.fail(fmt::format("meshes {}", number), "must have a list of primitives");
    firstVertexOf_.clear();
    for (const Json& primitive : *primitives) {
      if (!primitive.is_object()) document_.fail(fmt::format("meshes {}", number), "a primitive is no object, must be");
      addPrimitive(primitive, number, place);
    }
  }

  /// Points and lines bound nothing and are passed over.
  void addPrimitive(const Json& primitive, std::size_t number, const Affine& place) {
    const std::size_t mode = document_.number(primitive, "mode").value_or(static_cast<std::size_t>(Mode::triangles));
    if (mode > static_cast<std::size_t>(Mode::fan))
      document_.fail(fmt::format("meshes {}", number), fmt::format("mode {}: must be 0 to 6", mode));
    if (mode < static_cast<std::size_t>(Mode::triangles)) return;
    if (primitive.contains("extensions") && primitive["extensions"].contains("KHR_draco_mesh_compression"))
      document_.fail(fmt::format("meshes {}", number), "is compressed by Draco, must be stored without it");
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object() || !attributes->contains("POSITION"))
      document_.fail(fmt::format("meshes {}", number), "a primitive without POSITION, must have it");
    const auto [first, count] = addVertices(*attributes, number, place);
    const std::size_t before = mesh_.triangles.size();
    addTriangles(cornersOf(primitive, count), static_cast<Mode>(mode), first, determinant(place.linear) < 0, number);
    addMaterial(primitive, mesh_.triangles.size() - before);
  }

  void charge(std::size_t items) {
    if (items > copiesAllowed + document_.bytesPresent() - charged_)
      document_.fail("nodes", fmt::format("copies of meshes make more than {} vertices, must be fewer", copiesAllowed));
    charged_ += items;
  }

  struct VertexRange {
    std::uint32_t first = 0, count = 0;
  };

  /// Primitives of one mesh that name the same accessors share the vertices.
  VertexRange addVertices(const Json& attributes, std::size_t number, const Affine& place) {
    const auto position = document_.number(attributes, "POSITION"), normal = document_.number(attributes, "NORMAL"),
               uv = document_.number(attributes, "TEXCOORD_0");
    const auto [known, isNew] = firstVertexOf_.try_emplace(std::tuple(position, normal, uv));
    if (!isNew) return known->second;
    const std::size_t first = mesh_.vertices.size(), count = document_.count(*position, 3);
    const auto demandCount = [&](const std::optional<std::size_t>& accessor, std::size_t width) {
      if (accessor && document_.count(*accessor, width) != count)
        document_.fail(fmt::format("accessors {}", *accessor), fmt::format("must have {} rows as its POSITION", count));
    };
    demandCount(normal, 3);
    demandCount(uv, 2);
    charge(count);
    if (first + count >= notGiven) document_.fail("meshes", "more vertices than 4294967294 in all, must be fewer");
    addPositions(document_.reals(*position, 3, false), place, number);
    mesh_.normals.resize(first + count);
    mesh_.uvs.resize(first + count);
    hasNormal_.resize(first + count, normal.has_value());
    if (normal) addNormals(document_.reals(*normal, 3, false), first, place);
    if (uv) addUvs(document_.reals(*uv, 2, true), first);
    return known->second = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)};
  }

  void addPositions(const std::vector<double>& values, const Affine& place, std::size_t number) {
    for (std::size_t i = 0; i < values.size(); i += 3) {
      const Vec3d p = place.linear * Vec3d{values[i], values[i + 1], values[i + 2]} + place.offset;
      if (!isFinite(p))
        document_.fail(fmt::format("meshes {}", number), "a vertex that its nodes move out of range, must be finite");
      mesh_.vertices.push_back(p);
    }
  }

  void addNormals(const std::vector<double>& values, std::size_t first, const Affine& place) {
    const Mat3 turn = cofactors(place.linear) * (determinant(place.linear) < 0 ? -1.0 : 1.0);
    for (std::size_t i = 0; i < values.size(); i += 3) {
      const Vec3d given{values[i], values[i + 1], values[i + 2]};
      const Vec3d n = place.linear == Mat3{} ? given : normalized(turn * given);
      const std::size_t vertex = first + i / 3;
      hasNormal_[vertex] = isFinite(n) && n != Vec3d{};
      if (hasNormal_[vertex]) mesh_.normals[vertex] = n;
      hasNormals_ = true;
    }
  }

  /// Our v runs up the picture, glTF's down.
  void addUvs(const std::vector<double>& values, std::size_t first) {
    for (std::size_t i = 0; i < values.size(); i += 2) mesh_.uvs[first + i / 2] = {values[i], 1 - values[i + 1]};
    hasUvs_ = true;
  }

  std::vector<std::uint32_t> cornersOf(const Json& primitive, std::uint32_t count) {
    std::vector<std::uint32_t> corners;
    if (const auto accessor = document_.number(primitive, "indices")) {
      charge(document_.count(*accessor, 1));
      corners = document_.indices(*accessor);
      for (std::size_t i = 0; i < corners.size(); ++i)
        if (corners[i] >= count)
          document_.fail(fmt::format("accessors {}", *accessor),
                         fmt::format("row {}: vertex {}: must be below {}", i, corners[i], count));
      return corners;
    }
    charge(count);
    corners.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) corners[i] = i;
    return corners;
  }

  void addTriangles(const std::vector<std::uint32_t>& corners, Mode mode, std::uint32_t first, bool mirrored,
                    std::size_t number) {
    if (mode == Mode::triangles && corners.size() % 3 != 0)
      document_.fail(fmt::format("meshes {}", number), fmt::format("{} corners, must be threes", corners.size()));
    const std::size_t step = mode == Mode::triangles ? 3 : 1;
    for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
      const std::size_t a = mode == Mode::fan ? 0 : i, odd = mode == Mode::strip && i % 2 == 1 ? 1 : 0;
      Triangle t{first + corners[a], first + corners[i + 1 + odd], first + corners[i + 2 - odd]};
      if (mirrored) std::swap(t[1], t[2]);
      mesh_.triangles.push_back(t);
    }
  }

  void addMaterial(const Json& primitive, std::size_t triangles) {
    const auto number = document_.number(primitive, "material");
    namesMaterials_ = namesMaterials_ || number.has_value();
    const auto [entry, isNew] = numberOf_.try_emplace(number, mesh_.materialNames.size());
    if (isNew) mesh_.materialNames.push_back(number ? nameOf(*number) : "default");
    if (mesh_.materialNames.size() > std::numeric_limits<std::uint16_t>::max() + std::size_t{1})
      document_.fail("materials", "more than 65536, must be fewer");
    mesh_.materials.insert(mesh_.materials.end(), triangles, static_cast<std::uint16_t>(entry->second));
  }

  std::string nameOf(std::size_t material) const {
    const Json& entry = document_.entry("materials", material);
    const std::string name =
        entry.contains("name") && entry["name"].is_string() ? printable(entry["name"].get<std::string>()) : "";
    return trimmed(name).empty() ? fmt::format("material {}", material) : std::string(trimmed(name));
  }

  void finish() {
    if (hasNormals_)
      makeUpNormals(mesh_, hasNormal_);
    else
      mesh_.normals.clear();
    if (!hasUvs_) mesh_.uvs.clear();
    if (namesMaterials_) return;
    mesh_.materials.clear();
    mesh_.materialNames.clear();
  }

  GltfDocument& document_;
  const Json& root_;
  TriangleMesh mesh_;
  std::vector<bool> hasNormal_;
  bool hasNormals_ = false, hasUvs_ = false, namesMaterials_ = false;
  std::size_t charged_ = 0;
  std::map<std::tuple<std::optional<std::size_t>, std::optional<std::size_t>, std::optional<std::size_t>>, VertexRange>
      firstVertexOf_;
  std::map<std::optional<std::size_t>, std::size_t> numberOf_;
};

}  // namespace

TriangleMesh gltfFromBytes(std::string_view bytes, const std::string& file, const std::filesystem::path& folder) {
  GltfDocument document(bytes, file, folder);
  return GltfReader(document).read();
}

}  // namespace brisance
