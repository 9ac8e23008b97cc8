#include "render_inputs.h"

#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "mesh/shapes.h"
#include "render/noise.h"
#include "render/scattering.h"

namespace brisance::bench {
namespace {

constexpr int side = 1024;        // [pixels] of the picture of rays
constexpr int block = 4;          // [pixels] whose rays go together
constexpr int volumeCells = 300;  // along each edge

FrameBody bodyOf(TriangleMesh mesh, const Pose& pose = {}) {
  FrameBody body;
  body.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  body.material = "any";
  body.pose = pose;
  return body;
}

TriangleMesh roughBall(double radius, int segments, double roughness, double frequency) {
  TriangleMesh mesh = sphereMesh(radius, segments, false);
  parallelFor(0, std::ssize(mesh.vertices), 1024, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t v = first; v < last; ++v) {
      Vec3d& place = mesh.vertices[v];
      place *= 1 + roughness * harmonicNoise(normalized(place) * frequency + Vec3d(7, 7, 7), {2, 2, 6});
    }
  });
  mesh.normals.clear();
  return mesh;
}

/// Calls visit(x, y) over all pixels, `block` x `block` of them after one another.
template <class Visit>
void byBlocks(int width, int height, const Visit& visit) {
  for (int top = 0; top < height; top += block)
    for (int left = 0; left < width; left += block)
      for (int y = top; y < top + block; ++y)
        for (int x = left; x < left + block; ++x) visit(x, y);
}

float between(const Grid3<float>& grid, const Vec3d& cells) {
  double sum = 0;
  int first[3];
  double share[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double inside = std::clamp(cells[axis], 0.0, grid.size[axis] - 1.0);
    first[axis] = std::min(static_cast<int>(inside), grid.size[axis] - 2);
    share[axis] = inside - first[axis];
  }
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    sum += (x ? share[0] : 1 - share[0]) * (y ? share[1] : 1 - share[1]) * (z ? share[2] : 1 - share[2]) *
           grid(first[0] + x, first[1] + y, first[2] + z);
  }
  return static_cast<float>(sum);
}

Vec3f fireColour(double heat) {
  const auto h = static_cast<float>(heat);
  return {2 * h * h, 1.4f * h * h * h, 0.7f * h * h * h * h};
}

}  // namespace

std::vector<FrameBody> noisyBalls() { return {bodyOf(roughBall(1, 960, 0.35, 4)), bodyOf(roughBall(4, 320, 0.1, 6))}; }

std::vector<FrameBody> shards() {
  constexpr int columns = 32, rows = 16;
  const Random random(7, Stream::test);
  const auto mesh = std::make_shared<const TriangleMesh>(boxMesh({3.0 / columns, 1.5 / rows, 0.02}, false));
  std::vector<FrameBody> bodies;
  for (int n = 0; n < columns * rows; ++n) {
    const Vec3d place((n % columns + 0.5) * 3.0 / columns - 1.5, (n / columns + 0.5) * 1.5 / rows - 0.75, 0);
    FrameBody body;
    body.mesh = mesh;
    body.material = "any";
    body.pose = {place * 1.3 + Vec3d(0, 0, random.uniform(2 * n)),
                 axisAngle(random.onSphere(n), 3 * random.uniform(2 * n + 1))};
    bodies.push_back(body);
  }
  return bodies;
}

std::vector<Ray> cameraRays() {
  std::vector<Ray> rays;
  byBlocks(side, side, [&](int x, int y) {
    const auto u = static_cast<float>((x + 0.5) / side * 2 - 1) * 1.26f,
               v = static_cast<float>((y + 0.5) / side * 2 - 1) * 0.63f;
    rays.push_back({{0, 0, 2.6f}, normalized(Vec3f(u, v, -1)), 1e-4f, 0});
  });
  return rays;
}

std::vector<Ray> bouncedRays(const SceneGeometry& geometry, const std::vector<Ray>& from) {
  const Random random(3, Stream::test);
  std::vector<Ray> rays;
  for (std::size_t n = 0; n < from.size(); ++n) {
    SurfaceHit hit;
    if (!geometry.closest(from[n], hit)) continue;
    const Vec3f normal = dot(hit.normal, from[n].direction) > 0 ? -hit.normal : hit.normal;
    const Vec3f local =
        cosineDirection(static_cast<float>(random.uniform(2 * n)), static_cast<float>(random.uniform(2 * n + 1)));
    rays.push_back({from[n].origin + from[n].direction * hit.distance + normal * 1e-3f, Axes(normal, {}).toWorld(local),
                    1e-4f, 0});
  }
  return rays;
}

const ParticleVolume& explosion() {
  static const ParticleVolume volume = [] {
    const Vec3i size(volumeCells, volumeCells, volumeCells);
    const double cell = 2.0 / volumeCells;
    const Vec3d first(-1 + cell / 2, -1 + cell / 2, -1 + cell / 2);
    ParticleVolume made{Grid3<float>(size, first, cell), Grid3<Vec3f>(size, first, cell)};
    parallelFor(0, volumeCells, 1, [&](std::int64_t from, std::int64_t to) {
      for (int k = static_cast<int>(from); k < to; ++k)
        for (int j = 0; j < volumeCells; ++j)
          for (int i = 0; i < volumeCells; ++i) {
            const Vec3d place = made.density.position(i, j, k);
            const double noise = 1.6 * harmonicNoise(place * 2.0 + Vec3d(9, 9, 9), {1.8, 2, 5}), r = length(place);
            const double density =
                std::clamp((0.72 + 0.16 * noise - r) * 6, 0.0, 1.0) * std::clamp(0.55 + 0.45 * noise, 0.05, 1.5);
            if (density < 0.02) continue;
            made.density(i, j, k) = static_cast<float>(density);
            made.colour(i, j, k) = fireColour(std::clamp(1.15 - r / 0.8 + 0.25 * noise, 0.0, 1.0));
          }
    });
    return made;
  }();
  return volume;
}

VolumeSettings explosionSettings() {
  VolumeSettings settings;
  settings.blur = 0;  // steps of one cell
  settings.fullDensity = 2;
  settings.opacity = 15;  // 0.05 for each cell of density 1
  return settings;
}

std::vector<GasPath> pathsThroughExplosion() {
  constexpr int width = 1920, height = 1080;
  std::vector<GasPath> paths;
  byBlocks(width, height, [&](int x, int y) {
    const double u = ((x + 0.5) / width * 2 - 1) * width / height * 0.36, v = ((y + 0.5) / height * 2 - 1) * 0.36;
    const Vec3d seen = normalized(Vec3d(u, v, -1));
    // Seen from an angle to the axes.
    const Vec3d direction(0.8 * seen.x + 0.6 * seen.z, seen.y, -0.6 * seen.x + 0.8 * seen.z);
    paths.push_back({{0.6f * 3.4f, 0, 0.8f * 3.4f}, Vec3f(direction), 0, 1e6f});
  });
  return paths;
}

GasPassage finePassage(const GasPath& path) {
  const ParticleVolume& volume = explosion();
  const GasOptics optics(explosionSettings());
  const double step = volume.density.cellSize / 8;
  Vec3d light;
  double transmittance = 1;
  for (double t = 1.6; t < 5.2 && transmittance > 1e-6; t += step) {
    const Vec3d cells =
        (Vec3d(path.origin) + Vec3d(path.direction) * (t + step / 2) - volume.density.origin) / volume.density.cellSize;
    if (std::max({std::abs(cells.x - 149.5), std::abs(cells.y - 149.5), std::abs(cells.z - 149.5)}) > 149.5) continue;
    const float density = between(volume.density, cells);
    if (density <= 0) continue;
    Vec3d weighted;  // density times colour is what is mixed
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3i at(std::min(static_cast<int>(cells.x), volumeCells - 2) + (corner & 1),
                     std::min(static_cast<int>(cells.y), volumeCells - 2) + (corner >> 1 & 1),
                     std::min(static_cast<int>(cells.z), volumeCells - 2) + (corner >> 2));
      const double share =
          (1 - std::abs(cells.x - at.x)) * (1 - std::abs(cells.y - at.y)) * (1 - std::abs(cells.z - at.z));
      weighted += Vec3d(volume.colour(at.x, at.y, at.z)) * (share * volume.density(at.x, at.y, at.z));
    }
    const double opacity = -std::expm1(-optics.extinction(density) * step);
    light += weighted * (transmittance * opacity / density);
    transmittance *= 1 - opacity;
  }
  return {Vec3f(light), static_cast<float>(transmittance)};
}

}  // namespace brisance::bench
