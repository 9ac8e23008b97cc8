// Python's dictionaries, lists, numbers and texts as a scene's tree.
#include "base/check.h"
#include "bindings.h"

namespace brisance::python {
namespace {

using Kind = SceneNode::Kind;
constexpr const char* place = "scene";  // what messages name where a file would stand
constexpr int deepest = 64;             // a scene has no use for more than a few

class Converter {
 public:
  explicit Converter(GivenMeshes& meshes) : meshes_(meshes) {}

  SceneNode table(const py::dict& items, const std::string& path, int depth) {
    SceneNode node = nodeOf(Kind::table);
    for (const auto& [key, value] : items) {
      if (!py::isinstance<py::str>(key)) refuse(path, "keys must be texts", key);
      const std::string name = py::cast<std::string>(key);
      node.children.push_back(nodeOf(value, path.empty() ? name : fmt::format("{}.{}", path, name), depth + 1));
      node.children.back().key = name;
    }
    return node;
  }

 private:
  static SceneNode nodeOf(Kind kind) {
    SceneNode node;
    node.kind = kind;
    node.place = place;
    return node;
  }
  [[noreturn]] static void refuse(const std::string& path, const char* what, const py::handle& got) {
    throw InputError(fmt::format("{}: {}: {}, got {}", place, quoted(path), what,
                                 quoted(py::cast<std::string>(py::repr(py::type::of(got))))));
  }

  SceneNode nodeOf(const py::handle& value, const std::string& path, int depth) {
    if (depth > deepest) refuse(path, "must nest less deeply", value);
    if (py::isinstance<py::dict>(value)) return table(py::reinterpret_borrow<py::dict>(value), path, depth);
    if (py::isinstance<Mesh>(value)) return mesh(py::cast<const Mesh&>(value));
    if (py::isinstance<py::bool_>(value)) return flag(py::cast<bool>(value));
    if (py::isinstance<py::int_>(value)) return integer(value);
    if (py::isinstance<py::float_>(value)) return number(py::cast<double>(value));
    if (py::isinstance<py::str>(value)) return text(py::cast<std::string>(value));
    if (py::hasattr(value, "__fspath__")) return text(py::cast<std::string>(value.attr("__fspath__")()));
    if (py::hasattr(value, "tolist")) return nodeOf(value.attr("tolist")(), path, depth + 1);  // NumPy's
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) return array(value, path, depth);
    refuse(path, "must be a number, a text, true or false, a list or a dictionary", value);
  }
  SceneNode array(const py::handle& items, const std::string& path, int depth) {
    SceneNode node = nodeOf(Kind::array);
    for (const py::handle item : items)
      node.children.push_back(nodeOf(item, fmt::format("{}.{}", path, node.children.size()), depth + 1));
    return node;
  }
  static SceneNode flag(bool value) {
    SceneNode node = nodeOf(Kind::flag);
    node.flag = value;
    return node;
  }
  static SceneNode number(double value) {
    SceneNode node = nodeOf(Kind::number);
    node.number = value;
    return node;
  }
  /// A number too large for 64 bits is no whole number to a scene.
  static SceneNode integer(const py::handle& value) {
    int tooLarge = 0;
    const long long whole = PyLong_AsLongLongAndOverflow(value.ptr(), &tooLarge);
    SceneNode node = number(tooLarge ? tooLarge * 1e300 : static_cast<double>(whole));
    if (!tooLarge) node.kind = Kind::integer;
    node.integer = whole;
    return node;
  }
  static SceneNode text(const std::string& value) {
    SceneNode node = nodeOf(Kind::text);
    node.text = value;
    return node;
  }
  /// Stands where a file's name would.
  SceneNode mesh(const Mesh& mesh) {
    const std::string name = fmt::format("<mesh {}>", meshes_.size() + 1);
    meshes_[name] = mesh.triangles;
    return text(name);
  }

  GivenMeshes& meshes_;
};

}  // namespace

SceneTree treeOfDictionary(const py::dict& tables, const std::filesystem::path& directory) {
  SceneTree tree;
  tree.root = Converter(tree.meshes).table(tables, "", 0);
  tree.directory = std::filesystem::absolute(directory);
  return tree;
}

}  // namespace brisance::python
