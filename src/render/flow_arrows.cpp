#include "render/flow_arrows.h"

#include <algorithm>
#include <cmath>

#include "grid/interpolate.h"

namespace brisance {
namespace {

/// Some unit vector across a unit vector.
Vec3d across(const Vec3d& along) {
  const Vec3d other = std::abs(along.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0);
  return normalized(cross(along, other));
}

/// A shaft of four sides, and a head that is a pyramid.
void addArrow(const Vec3d& from, const Vec3d& along, double thickness, TriangleMesh& mesh) {
  const double size = length(along), head = std::min(4 * thickness, size / 2);
  const Vec3d way = along / size, a = across(way), b = cross(way, a);
  const auto ring = [&](double distance, double radius) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3d& side : {a, b, -a, -b}) mesh.vertices.push_back(from + way * distance + side * radius);
    return first;
  };
  const auto join = [&](std::uint32_t lower, std::uint32_t upper) {
    for (std::uint32_t n = 0; n < 4; ++n) {
      const std::uint32_t next = (n + 1) % 4;
      mesh.triangles.push_back({lower + n, lower + next, upper + next});
      mesh.triangles.push_back({lower + n, upper + next, upper + n});
    }
  };
  const std::uint32_t start = ring(0, thickness / 2), neck = ring(size - head, thickness / 2);
  const std::uint32_t rim = ring(size - head, 1.5 * thickness), tip = ring(size, 0.02 * thickness);
  mesh.triangles.push_back({start, start + 2, start + 1});
  mesh.triangles.push_back({start, start + 3, start + 2});
  join(start, neck);
  join(neck, rim);
  join(rim, tip);
}

float fastest(const SparseGrid<Vec3f>& velocity) {
  float most = 0;
  for (const auto& brick : velocity.bricks)
    for (const Vec3f& v : brick.values) most = std::max(most, length(v));
  return most;
}

}  // namespace

TriangleMesh flowArrows(const FrameGas& gas, const FlowSettings& settings) {
  TriangleMesh mesh;
  const Grid3<Vec3f> velocity = makeDense(gas.velocity);
  const double slow = 0.01 * fastest(gas.velocity);
  const Vec3d size = settings.upper - settings.lower;
  Vec3i counts;
  for (int axis = 0; axis < 3; ++axis) counts[axis] = 1 + static_cast<int>(size[axis] / settings.spacing + 1e-9);
  const Vec3d first = settings.lower + (size - Vec3d(counts - Vec3i(1, 1, 1)) * settings.spacing) / 2.0;
  for (int k = 0; k < counts.z; ++k)
    for (int j = 0; j < counts.y; ++j)
      for (int i = 0; i < counts.x; ++i) {
        const Vec3d place = first + Vec3d(i, j, k) * settings.spacing;
        const Vec3d flow(interpolate(velocity, place));
        if (length(flow) > slow) addArrow(place, flow * settings.seconds, 0.08 * settings.spacing, mesh);
      }
  return mesh;
}

void addFlow(const FrameGas& gas, const FlowSettings& settings, std::vector<FrameBody>& bodies,
             std::map<std::string, Material>& materials) {
  FrameBody body;
  body.name = body.material = "@flow";  // no body of a scene has an @
  body.mesh = std::make_shared<const TriangleMesh>(flowArrows(gas, settings));
  body.moves = false;
  Material& material = materials[body.material];
  material.diffuse = SolidColour{settings.colour};
  material.castsShadow = false;
  bodies.push_back(std::move(body));
}

}  // namespace brisance
