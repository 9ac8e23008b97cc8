// A mesh on the doctor's table: triangles that know both their attributes and their places.
#pragma once

#include "mesh/mesh_repair.h"

namespace brisance {

struct Patient {
  TriangleMesh mesh;                   ///< vertices with attributes; its triangles are those still there
  std::vector<std::uint32_t> placeOf;  ///< per vertex, the first vertex at its place
  std::vector<std::uint32_t> source;   ///< per triangle
  std::vector<std::string> done;

  Triangle places(std::size_t t) const {
    const Triangle& v = mesh.triangles[t];
    return {placeOf[v[0]], placeOf[v[1]], placeOf[v[2]]};
  }
  std::vector<Triangle> allPlaces() const;
  const Vec3d& at(std::uint32_t vertex) const { return mesh.vertices[vertex]; }
  Vec3d centre(std::size_t t) const;
  /// Notes a triangle by its number in the input.
  void count(Defect& defect, std::size_t t) const { defect.note(centre(t), source[t]); }
  /// Keeps the triangles of which `keep` says so.
  void keepOnly(const std::vector<bool>& keep);
  /// Adds "WHAT: 3, the first at ..." to what was done, where there was anything.
  void note(const char* what, const Defect& defect);
};

void weldClose(Patient& patient, double distance);
void dropRepeatedCorners(Patient& patient);
void dropDuplicates(Patient& patient);
/// A triangle of no area whose long side has a neighbour gives its middle corner to that: the side is turned.
void turnSlivers(Patient& patient);
/// Closes holes of at most so many edges with triangles of least area; whether there were any. After orient().
bool fillHoles(Patient& patient, std::size_t mostEdges);

/// How triangles hang together: per edge the neighbour over it, where it has two triangles, or more that can be told
/// apart.
struct Sheets {
  std::vector<Triangle> neighbours;
  Defect openEdges, tangledEdges, twistedEdges;
  void turnOver(Patient& patient, std::uint32_t triangle);
};
/// Turns triangles to agree with their neighbours, as most of each sheet do.
Sheets orient(Patient& patient);

}  // namespace brisance
