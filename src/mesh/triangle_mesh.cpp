#include "mesh/triangle_mesh.h"

namespace brisance {

Box3 bounds(const TriangleMesh& mesh) {
  Box3 box;
  for (const Vec3d& v : mesh.vertices) box.include(v);
  return box;
}

void recenter(TriangleMesh& mesh, const Vec3d& offset) {
  for (Vec3d& v : mesh.vertices) v -= offset;
}

}  // namespace brisance
