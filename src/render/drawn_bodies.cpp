#include "render/drawn_bodies.h"

#include <algorithm>

namespace brisance {

Pose poseAfter(const FrameBody& body, double seconds) {
  const double speed = length(body.angularVelocity);
  const Vec3d position = body.pose.position + body.linearVelocity * seconds;
  if (speed * seconds == 0) return {position, body.pose.orientation};
  return {position, normalized(axisAngle(body.angularVelocity / speed, speed * seconds) * body.pose.orientation)};
}

namespace {

DrawnBody drawnBody(const FrameBody& body, const MaterialTable& materials) {
  DrawnBody drawn{body.mesh, materials.ofTriangles(body), {}, rotationMatrix(body.pose.orientation)};
  const bool smooth = std::any_of(drawn.materials.begin(), drawn.materials.end(),
                                  [&](std::uint16_t m) { return materials[m].settings.smooth; });
  if (smooth && body.mesh->normals.empty()) drawn.normals = vertexNormals(*body.mesh);
  return drawn;
}

template <class T>
T atCorners(const std::vector<T>& values, const Triangle& triangle, double u, double v) {
  return values[triangle[0]] * (1 - u - v) + values[triangle[1]] * u + values[triangle[2]] * v;
}

/// The way u grows over a triangle (uVec of appendix A.1.2, up to its length); zero where no u v tells.
Vec3d alongU(const TriangleMesh& mesh, const Triangle& t) {
  if (mesh.uvs.empty()) return {};
  const Vec2d a = mesh.uvs[t[1]] - mesh.uvs[t[0]], b = mesh.uvs[t[2]] - mesh.uvs[t[0]];
  const double m = a.x * b.y - a.y * b.x;
  const Vec3d along =
      (mesh.vertices[t[1]] - mesh.vertices[t[0]]) * b.y - (mesh.vertices[t[2]] - mesh.vertices[t[0]]) * a.y;
  return m < 0 ? -along : m > 0 ? along : Vec3d{};
}

}  // namespace

void DrawnBodies::add(const FrameBody& body) {
  drawn_.push_back(drawnBody(body, materials_));
  for (const std::uint16_t m : drawn_.back().materials)
    anyLetsLightPass_ |= materials_[m].settings.glass || !materials_[m].settings.castsShadow;
}

SurfaceHit DrawnBodies::surfaceAt(const FoundTriangle& found) const {
  const DrawnBody& body = drawn_[found.body];
  const Triangle& triangle = body.mesh->triangles[found.triangle];
  SurfaceHit hit;
  hit.distance = found.distance;
  hit.normal = normalized(found.across);
  hit.body = found.body;
  hit.material = body.material(found.triangle);
  const double u = found.u, v = found.v;
  const SurfaceMaterial& material = materials_[hit.material];
  hit.shadingNormal = material.settings.smooth
                          ? Vec3f(normalized(body.rotation * atCorners(body.smoothNormals(), triangle, u, v)))
                          : hit.normal;
  const Vec2d uv = body.mesh->uvs.empty() ? Vec2d{} : atCorners(body.mesh->uvs, triangle, u, v);
  hit.texture.uv = {static_cast<float>(uv.x), static_cast<float>(uv.y)};
  if (material.isSolidPattern()) hit.texture.inBody = Vec3f(atCorners(body.mesh->vertices, triangle, u, v));
  if (material.isAnisotropic()) hit.alongU = Vec3f(body.rotation * alongU(*body.mesh, triangle));
  return hit;
}

}  // namespace brisance
