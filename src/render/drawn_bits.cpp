#include "render/drawn_bits.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace brisance {
namespace {

constexpr double kelvinPerStep = 100;

FrameBody scenery(const std::string& name, TriangleMesh mesh) {
  FrameBody body;
  body.name = body.material = name;
  body.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  body.moves = false;
  return body;
}

/// A thin spindle from tip to tip, of three sides.
void addStreak(const Vec3d& from, const Vec3d& to, double width, TriangleMesh& mesh) {
  const Vec3d along = to - from, way = normalized(along);
  const Vec3d a = normalized(cross(way, std::abs(way.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0))), b = cross(way, a);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Vec3d middle = (from + to) / 2.0;
  mesh.vertices.push_back(from);
  for (const auto& [s, t] : {std::pair{1.0, 0.0}, {-0.5, 0.866}, {-0.5, -0.866}})
    mesh.vertices.push_back(middle + (a * s + b * t) * (width / 2));
  mesh.vertices.push_back(to);
  for (std::uint32_t side = 0; side < 3; ++side) {
    const std::uint32_t p = first + 1 + side, q = first + 1 + (side + 1) % 3;
    mesh.triangles.push_back({first, q, p});
    mesh.triangles.push_back({p, q, first + 4});
  }
}

void addGrain(const Vec3d& place, const Random& random, std::uint64_t index, double size, TriangleMesh& mesh) {
  const Vec3d a = random.onSphere(2 * index), b = normalized(cross(a, random.onSphere(2 * index + 1)));
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(place + a * (size / 2));
  mesh.vertices.push_back(place + (b - a * 0.6) * (size / 2));
  mesh.vertices.push_back(place - (b + a * 0.6) * (size / 2));
  mesh.triangles.push_back({first, first + 1, first + 2});
}

void addSparks(const FrameParticles& particles, const BitsLook& settings, const BlackbodyColours& heat,
               std::vector<FrameBody>& bodies, std::map<std::string, Material>& materials) {
  std::map<int, TriangleMesh> steps;
  for (std::size_t p = 0; p < particles.kind.size(); ++p) {
    if (particles.kind[p] != static_cast<std::uint8_t>(FrameKind::spark)) continue;
    const Vec3d place(particles.position[p]);
    Vec3d back = Vec3d(particles.velocity[p]) * settings.sparkSeconds;
    if (length(back) < settings.sparkWidth) back = Vec3d(0, settings.sparkWidth, 0);
    addStreak(place - back, place, settings.sparkWidth,
              steps[static_cast<int>(particles.temperature[p] / kelvinPerStep)]);
  }
  for (auto& [step, mesh] : steps) {
    const Vec3f colour =
        heat(static_cast<float>((step + 0.5) * kelvinPerStep)) * static_cast<float>(settings.sparkEmission);
    if (std::max({colour.x, colour.y, colour.z}) < 1e-3f) continue;
    const std::string name = fmt::format("@sparks.{:03}", step);
    Material& material = materials[name];
    material.diffuse = SolidColour{{1, 1, 1}};
    material.diffuseWeight = 0;
    material.ambient = {};
    material.emission = colour;
    material.castsShadow = false;
    bodies.push_back(scenery(name, std::move(mesh)));
  }
}

}  // namespace

void addBits(const Frame& frame, const BitsLook& settings, const BlackbodyColours& heat, std::vector<FrameBody>& bodies,
             std::map<std::string, Material>& materials) {
  addSparks(frame.particles, settings, heat, bodies, materials);
  const Random random(static_cast<std::uint64_t>(frame.index), Stream::dust);
  TriangleMesh grains;
  for (std::size_t p = 0; p < frame.particles.kind.size(); ++p)
    if (frame.particles.kind[p] == static_cast<std::uint8_t>(FrameKind::dust))
      addGrain(Vec3d(frame.particles.position[p]), random, p, settings.grainSize, grains);
  if (grains.triangles.empty()) return;
  const std::string name = "@dust";  // no body of a scene has an @
  Material& material = materials[name];
  material.diffuse = SolidColour{settings.grainColour};
  material.reflection = settings.grainReflection;
  material.castsShadow = false;
  bodies.push_back(scenery(name, std::move(grains)));
}

}  // namespace brisance
