// What is right and wrong with a mesh.
#pragma once

#include "mesh/self_crossing.h"
#include "mesh/triangle_mesh.h"

namespace brisance {

/// How often something is wrong, and where first.
struct Defect {
  std::size_t count = 0;
  Vec3d at;                    ///< [m] of the first
  std::uint32_t triangle = 0;  ///< the first's number, from 0
  void note(const Vec3d& place, std::uint32_t number);
};
/// "3, the first at (0.1, 0.2, 0.3), triangle 17": triangles are counted from 1, as people count lines.
std::string textOf(const Defect& defect);

/// Of the surface in which vertices at exactly the same place are one, without triangles of a repeated corner.
struct MeshReport {
  std::size_t vertices = 0, triangles = 0;
  std::size_t places = 0;          ///< different places of the vertices in use
  std::size_t unusedVertices = 0;  ///< named by no triangle
  std::size_t parts = 0;           ///< connected across edges
  bool closed = false;             ///< every edge is used exactly once in each direction
  Defect holes;                    ///< loops of open edges
  std::size_t openEdges = 0;
  Defect tangledEdges;        ///< of more than two triangles
  Defect flippedEdges;        ///< whose two triangles go the same way: one of them faces inward
  Defect pinched;             ///< places where fans of triangles touch that share no edge there
  Defect repeated;            ///< triangles that come back to one of their corners
  Defect slivers;             ///< triangles of no area, of three different corners
  Defect duplicates;          ///< triangles of the same three corners as an earlier one, either way around
  Defect insideOut;           ///< closed parts that face the wrong way: inward, but for those inside another part
  bool nestingJudged = true;  ///< false: too many parts overlap to tell which lie inside which
  SelfCrossing crossing;
  Vec3d crossingAt;        ///< [m] of the first triangle that is cut
  double area = 0;         ///< [m2]
  double volume = 0;       ///< [m3], negative inside out; of a closed mesh only
  std::int64_t euler = 0;  ///< places - edges + triangles
  std::int64_t genus = 0;  ///< handles, of a closed mesh whose pinched places are taken apart
  Box3 box;
  bool hasNormals = false, hasUvs = false;
  std::vector<std::string> materialNames;
  /// Nothing stands against it as a solid's surface but what mesh_repair.h mends without a choice.
  bool isSound() const;
};

MeshReport examine(const TriangleMesh& mesh);
/// Several lines for people.
std::string meshReportText(const MeshReport& report);
/// One JSON object.
std::string meshReportJson(const MeshReport& report);

/// A triangle that has no area but for rounding.
bool isSliver(const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace brisance
