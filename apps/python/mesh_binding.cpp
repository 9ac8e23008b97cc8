// Meshes and what becomes of them.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "base/check.h"
#include "bindings.h"
#include "interruption.h"
#include "mesh/mass_properties.h"
#include "mesh/mesh_file.h"
#include "simulation/make_bodies.h"

namespace brisance::python {
namespace {

using Vertices = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Corners = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

template <class Array>
void requireRowsOfThree(const Array& array, const char* name) {
  if (array.ndim() == 2 && array.shape(1) == 3) return;
  std::string shape;
  for (py::ssize_t axis = 0; axis < array.ndim(); ++axis)
    shape += fmt::format("{}{}", axis ? ", " : "", array.shape(axis));
  throw InputError(fmt::format("mesh: {}: must be an array of shape (n, 3), got ({})", name, shape));
}

TriangleMesh meshOf(const Vertices& vertices, const Corners& corners) {
  requireRowsOfThree(vertices, "vertices");
  requireRowsOfThree(corners, "triangles");
  TriangleMesh mesh;
  const auto v = vertices.unchecked<2>();
  for (py::ssize_t n = 0; n < v.shape(0); ++n) {
    mesh.vertices.emplace_back(v(n, 0), v(n, 1), v(n, 2));
    if (!isFinite(mesh.vertices.back())) throw InputError(fmt::format("mesh: vertices: row {}: must be finite", n));
  }
  const auto t = corners.unchecked<2>();
  for (py::ssize_t n = 0; n < t.shape(0); ++n) {
    Triangle triangle;
    for (int corner = 0; corner < 3; ++corner) {
      if (t(n, corner) < 0 || t(n, corner) >= v.shape(0))
        throw InputError(fmt::format("mesh: triangles: row {}: must be numbers of vertices from 0 to {}, got {}", n,
                                     v.shape(0) - 1, t(n, corner)));
      triangle[corner] = static_cast<std::uint32_t>(t(n, corner));
    }
    mesh.triangles.push_back(triangle);
  }
  if (mesh.triangles.empty()) throw InputError("mesh: triangles: must be at least one");
  return mesh;
}

/// Whole numbers alone name vertices.
Mesh makeMesh(const Vertices& vertices, const py::array& triangles) {
  if (triangles.dtype().kind() != 'i' && triangles.dtype().kind() != 'u')
    throw InputError("mesh: triangles: must be whole numbers");
  return {std::make_shared<const TriangleMesh>(meshOf(vertices, Corners::ensure(triangles)))};
}

Mesh loadMesh(const std::filesystem::path& file) {
  const py::gil_scoped_release others;
  return {std::make_shared<const TriangleMesh>(readMesh(file))};
}

struct PyPiece {
  Mesh mesh;
  Vec3d place;
  MassProperties properties;
};
struct Broken {
  std::vector<PyPiece> pieces;
  std::vector<std::array<std::int32_t, 2>> bonds;
  std::vector<double> bondAreas;
  std::vector<int> pieceOfTriangle;
};

Broken broken(FracturedBody body) {
  Broken result;
  for (Piece& piece : body.pieces)
    result.pieces.push_back(
        {{std::make_shared<const TriangleMesh>(std::move(piece.mesh))}, piece.place, piece.properties});
  for (const Bond& bond : body.bonds) {
    result.bonds.push_back({bond.a, bond.b});
    result.bondAreas.push_back(bond.area);
  }
  result.pieceOfTriangle = std::move(body.pieceOfTriangle);
  return result;
}

/// As a scene whose one body is the mesh, so that its keys, checks and messages are the scene's.
std::shared_ptr<Broken> fractured(const Mesh& mesh, std::uint64_t seed, const py::kwargs& keys) {
  py::dict body;
  body["name"] = "mesh";
  body["shape"] = py::dict(py::arg("type") = "mesh", py::arg("file") = mesh);
  body["mass"] = 1.0;
  body["fracture"] = py::dict(keys);
  py::list bodies;
  bodies.append(body);
  const Scene scene = sceneOf(treeOfDictionary(py::dict(py::arg("bodies") = bodies), "."));
  return interruptibly(
      [&] { return std::make_shared<Broken>(broken(breakBody(scene.simulation.bodies.front(), seed))); });
}

}  // namespace

void bindMeshes(py::module_& module) {
  py::class_<Mesh>(module, "Mesh", "Triangles, counter-clockwise seen from outside.")
      .def(py::init(&makeMesh), py::arg("vertices"), py::arg("triangles"),
           "Copies `vertices` (n, 3) [m] and `triangles` (m, 3), whole numbers of vertices from 0.")
      .def_static("load", &loadMesh, py::arg("path"), "Of an OBJ, PLY, STL or glTF file.")
      .def(
          "save", [](const Mesh& mesh, const std::filesystem::path& path) { writeMesh(path, *mesh.triangles); },
          py::arg("path"), "As .obj or .ply.")
      .def_property_readonly(
          "vertices", [](const Mesh& mesh) { return viewOf(mesh.triangles->vertices, mesh.triangles); },
          "(n, 3) float64 [m]; a view, never changed.")
      .def_property_readonly(
          "triangles", [](const Mesh& mesh) { return viewOf(mesh.triangles->triangles, mesh.triangles); },
          "(m, 3) uint32, numbers of vertices; a view, never changed.");
  py::class_<PyPiece>(module, "Piece", "A piece of a broken mesh.")
      .def_readonly("mesh", &PyPiece::mesh, "About the piece's own centroid.")
      .def_property_readonly(
          "place", [](const PyPiece& piece) { return tupleOf(piece.place); },
          "x, y, z of the centroid in the mesh that was broken [m].")
      .def_property_readonly(
          "volume", [](const PyPiece& piece) { return piece.properties.volume; },
          "[m3]; of an open piece that of its shell.")
      .def_property_readonly(
          "area", [](const PyPiece& piece) { return piece.properties.area; }, "Of its surface [m2].");
  py::class_<Broken, std::shared_ptr<Broken>>(module, "Fracture", "A broken mesh.")
      .def_readonly("pieces", &Broken::pieces, "All pieces.")
      .def_property_readonly(
          "bonds", [](const std::shared_ptr<Broken>& b) { return viewOf(b->bonds, b); },
          "(k, 2) int32: pieces that touch; a view.")
      .def_property_readonly(
          "bond_areas", [](const std::shared_ptr<Broken>& b) { return viewOf(b->bondAreas, b); },
          "(k) float64: where they do [m2]; a view.")
      .def_property_readonly(
          "piece_of_triangle", [](const std::shared_ptr<Broken>& b) { return viewOf(b->pieceOfTriangle, b); },
          "(m) int32: the piece of each triangle of a mesh cut along its own triangles, else empty; a view.");
  module.def(
      "fracture", &fractured, py::arg("mesh"), py::arg("seed") = 1,
      "Break a mesh. Ctrl-C cuts it. The other arguments are the keys of a scene's table bodies.fracture: pieces=16,\n"
      "method=\"voronoi\" or method={\"type\": \"curvature\", ...}, solid=True ... Messages name them as\n"
      "bodies.mesh.fracture.KEY.");
}

}  // namespace brisance::python
