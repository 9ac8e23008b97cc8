#include "assets/models.h"

#include "assets/marching_tetrahedra.h"
#include "base/check.h"
#include "mesh/mesh_topology.h"

namespace brisance::samples {

EdgeSize edgeSizeOf(const Model& model) {
  return [details = model.details, fineness = model.fineness](const Vec3d& p) {
    constexpr double reach = 0.15;  // [m]
    const double t = std::clamp(details(p) / reach, 0.0, 1.0);
    return fineness + (1 - fineness) * t * t * (3 - 2 * t);
  };
}

TriangleMesh meshOf(const Model& model, long triangles) {
  const TriangleMesh raw = marchingTetrahedra(model.solid, model.box, model.finest);
  CHECK(isClosed(raw) && componentCount(raw) == 1, "the solid leaves its box, or has {} parts", componentCount(raw));
  TriangleMesh mesh = evenRemesh(raw, model.solid, edgeSizeOf(model), static_cast<std::size_t>(triangles / 2 * 2));
  constexpr double digits = 1e5;  // [1/m]
  for (Vec3d& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) v[axis] = std::round(v[axis] * digits) / digits + 0.0;  // no -0
  return mesh;
}

TriangleMesh cow(long triangles) { return meshOf(cowModel(), triangles); }
TriangleMesh teddy(long triangles) { return meshOf(teddyModel(), triangles); }
TriangleMesh statue(long triangles) { return meshOf(statueModel(), triangles); }
TriangleMesh pumpkin(long triangles) { return meshOf(pumpkinModel(), triangles); }

}  // namespace brisance::samples
