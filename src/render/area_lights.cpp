#include "render/area_lights.h"

#include <algorithm>
#include <cmath>

#include "render/scene_geometry.h"

namespace brisance {
namespace {

constexpr Vec3f luminanceWeights{0.2126f, 0.7152f, 0.0722f};

float luminanceOf(const SurfaceMaterial& material) {
  if (material.settings.glass || material.settings.emission == Vec3f{}) return 0;
  return dot(luminanceWeights, material.settings.emission * material.typicalColour());
}

}  // namespace

AreaLights::AreaLights(const std::vector<FrameBody>& bodies, const MaterialTable& materials, double openTime)
    : materials_(&materials) {
  for (std::size_t m = 0; m < materials.size(); ++m) luminances_.push_back(luminanceOf(materials[m]));
  for (const FrameBody& body : bodies) {
    const std::vector<std::uint16_t> ofTriangles = materials.ofTriangles(body);
    const auto shines = [&](std::uint16_t material) { return luminances_[material] > 0; };
    if (std::any_of(ofTriangles.begin(), ofTriangles.end(), shines)) add(body, ofTriangles, openTime);
  }
}

void AreaLights::add(const FrameBody& body, const std::vector<std::uint16_t>& ofTriangles, double openTime) {
  const TriangleMesh& mesh = *body.mesh;
  const double blur = body.moves ? openTime : 0;
  const Pose open = poseAfter(body, -blur / 2), close = poseAfter(body, blur / 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    ShiningTriangle triangle{};
    triangle.material = ofTriangles.size() == 1 ? ofTriangles[0] : ofTriangles[t];
    if (luminances_[triangle.material] <= 0) continue;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t vertex = mesh.triangles[t][c];
      triangle.corner[c] = Vec3f(open * mesh.vertices[vertex]);
      triangle.moved[c] = Vec3f(close * mesh.vertices[vertex]) - triangle.corner[c];
      triangle.inBody[c] = Vec3f(mesh.vertices[vertex]);
      if (!mesh.uvs.empty())
        triangle.uv[c] = {static_cast<float>(mesh.uvs[vertex].x), static_cast<float>(mesh.uvs[vertex].y)};
    }
    const Vec3f* p = triangle.corner;
    total_ += 0.5 * length(cross(p[1] - p[0], p[2] - p[0])) * luminances_[triangle.material];
    triangles_.push_back(triangle);
    upTo_.push_back(total_);
  }
}

AreaSample AreaLights::sample(float choice, const Vec2<float>& where, float time) const {
  const auto found = std::upper_bound(upTo_.begin(), upTo_.end(), choice * total_);
  const ShiningTriangle& triangle = triangles_[std::min<std::size_t>(found - upTo_.begin(), triangles_.size() - 1)];
  // Even over the triangle: Turk 1990, "Generating random points in triangles".
  const float root = std::sqrt(where.x), b = root * (1 - where.y), c = root * where.y, a = 1 - b - c;
  const auto corner = [&](int i) { return triangle.corner[i] + triangle.moved[i] * time; };
  const Vec3f p0 = corner(0), p1 = corner(1), p2 = corner(2);
  const TexturePlace texture{triangle.uv[0] * a + triangle.uv[1] * b + triangle.uv[2] * c,
                             triangle.inBody[0] * a + triangle.inBody[1] * b + triangle.inBody[2] * c};
  const SurfaceMaterial& material = (*materials_)[triangle.material];
  return {p0 * a + p1 * b + p2 * c, normalized(cross(p1 - p0, p2 - p0)),
          material.diffuseColour(texture) * material.settings.emission, density(triangle.material)};
}

}  // namespace brisance
