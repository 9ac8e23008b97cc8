// What every fuzz target does with the bytes it is given: reads, examines, repairs, writes, and holds each to its
// promises. Anything thrown but an Error is a find.
#pragma once

#include <string_view>

#include "base/check.h"
#include "mesh/disjoint_sets.h"
#include "mesh/mesh_formats.h"
#include "mesh/mesh_repair.h"
#include "mesh/mesh_topology.h"

namespace brisance::fuzz {

constexpr std::size_t smallMesh = 2000;  // triangles: larger ones are only read

inline void checkMesh(const TriangleMesh& mesh) {
  const std::size_t vertices = mesh.vertices.size();
  CHECK(mesh.normals.empty() || mesh.normals.size() == vertices, "{} of {}", mesh.normals.size(), vertices);
  CHECK(mesh.uvs.empty() || mesh.uvs.size() == vertices, "{} of {}", mesh.uvs.size(), vertices);
  CHECK(mesh.materials.empty() || mesh.materials.size() == mesh.triangles.size(), "{}", mesh.materials.size());
  for (const std::uint16_t m : mesh.materials) CHECK(m < mesh.materialNames.size(), "material {}", m);
  for (const Vec3d& v : mesh.vertices) CHECK(isFinite(v), "{} {} {}", v.x, v.y, v.z);
  for (const Vec3d& n : mesh.normals) CHECK(isFinite(n), "{} {} {}", n.x, n.y, n.z);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) CHECK(v < vertices, "vertex {} of {}", v, vertices);
}

/// One fan of triangles around each vertex of a closed surface.
inline void checkManifold(const TriangleMesh& surface) {
  CHECK(isClosed(surface), "a solid's surface is open");
  const std::vector<Triangle> neighbours = edgeNeighbours(surface);
  DisjointSets fans(3 * surface.triangles.size());
  const auto cornerAt = [&](std::uint32_t t, std::uint32_t vertex) {
    const Triangle& v = surface.triangles[t];
    return 3 * t + static_cast<std::uint32_t>(std::find(v.begin(), v.end(), vertex) - v.begin());
  };
  for (std::uint32_t t = 0; t < neighbours.size(); ++t)
    for (std::uint32_t e = 0; e < 3; ++e)
      for (const std::uint32_t end : {e, (e + 1) % 3})
        fans.join(3 * t + end, cornerAt(neighbours[t][e], surface.triangles[t][end]));
  std::vector<int> fansAt(surface.vertices.size(), 0);
  for (std::uint32_t corner = 0; corner < 3 * neighbours.size(); ++corner)
    fansAt[surface.triangles[corner / 3][corner % 3]] += fans.root(corner) == corner;
  for (const int count : fansAt) CHECK(count == 1, "{} fans at a vertex", count);
}

inline void checkRepair(const TriangleMesh& mesh, const RepairSettings& settings) {
  const RepairedMesh repaired = repair(mesh, settings);
  checkMesh(repaired.mesh);
  CHECK(repaired.sourceTriangle.size() == repaired.mesh.triangles.size(), "{}", repaired.sourceTriangle.size());
  for (const std::uint32_t t : repaired.sourceTriangle)
    CHECK(t == noTriangle || t < mesh.triangles.size(), "triangle {} of {}", t, mesh.triangles.size());
  CHECK(repaired.surfaceVertexOf.size() == repaired.mesh.vertices.size(), "{}", repaired.surfaceVertexOf.size());
  for (const std::uint32_t v : repaired.surfaceVertexOf) CHECK(v < repaired.surfaceVertices, "vertex {}", v);
  try {
    requireSolid(repaired, "fuzz");
  } catch (const Error&) {
    return;
  }
  checkManifold(bareSurface(repaired));
}

inline void checkRoundTrip(const TriangleMesh& mesh) {
  TriangleMesh again = plyFromBytes(plyBytes(mesh), "fuzz.ply");
  again.materialNames = mesh.materialNames;
  CHECK(again == mesh, "PLY does not bring a mesh of {} triangles back", mesh.triangles.size());
}

template <class Reader>
void takeMesh(const Reader& read, std::string_view bytes) {
  TriangleMesh mesh;
  try {
    mesh = read(bytes, "fuzz");
  } catch (const Error& refused) {
    CHECK(std::string_view(refused.what()).find('\n') == std::string_view::npos, "two lines: {}", refused.what());
    return;
  }
  checkMesh(mesh);
  if (mesh.triangles.size() > smallMesh) return;
  const MeshReport report = examine(mesh);
  CHECK(!meshReportText(report).empty() && !meshReportJson(report).empty(), "an empty report");
  checkRepair(mesh, {});
  const double length = brisance::length(report.box.size());
  if (std::isfinite(length) && length > 0) checkRepair(mesh, {0.01 * length, 8});
  checkRoundTrip(mesh);
}

inline void takeObj(std::string_view bytes) { takeMesh(objFromBytes, bytes); }
inline void takePly(std::string_view bytes) { takeMesh(plyFromBytes, bytes); }
inline void takeStl(std::string_view bytes) { takeMesh(stlFromBytes, bytes); }
inline void takeGltf(std::string_view bytes) {
  takeMesh([](std::string_view b, const std::string& file) { return gltfFromBytes(b, file, {}); }, bytes);
}

}  // namespace brisance::fuzz
