// Small frames that hold something of everything.
#pragma once

#include "base/random.h"
#include "frame/frame.h"
#include "grid/brick_source.h"

namespace brisance {

inline const Random& sampleRandom() {
  static const Random random(11, Stream::test);
  return random;
}

/// A ball of noise inside a grid whose sizes are no multiples of a brick's.
inline Grid3<float> ballOfNoise(float background) {
  Grid3<float> grid({20, 17, 30}, {-0.3, 0.1, 2}, 0.037, background);
  for (int k = 8; k < 27; ++k)
    for (int j = 2; j < 17; ++j)
      for (int i = 3; i < 20; ++i)
        grid(i, j, k) += static_cast<float>(sampleRandom().normal(static_cast<std::uint64_t>(grid.index(i, j, k))));
  return grid;
}

inline FrameGas sampleGas() {
  const Grid3<float> noise = ballOfNoise(0);
  Grid3<Vec3f> velocity(noise.size, noise.origin, noise.cellSize);
  for (std::int64_t n = 0; n < noise.count(); ++n) {
    const float v = noise.values[n];
    if (v != 0) velocity.values[n] = {v, -2 * v, 1 + v};
  }
  return {makeSparse(noise, 0.f), makeSparse(ballOfNoise(300), 300.f), makeSparse(noise, 0.f),
          makeSparse(velocity, Vec3f())};
}

/// All coordinates are exact in single precision, as the file keeps them.
inline TriangleMesh sampleTetrahedron() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1.5}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  mesh.normals = {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.uvs = {{0, 0}, {1, 0}, {0.25, 1}, {3, 0.5}};
  return mesh;
}

inline std::vector<FrameBody> sampleBodies() {
  const auto plain = std::make_shared<const TriangleMesh>(sampleTetrahedron());
  TriangleMesh painted = sampleTetrahedron();
  painted.uvs.clear();
  painted.materials = {1, 0, 1, 2};
  painted.materialNames = {"stone", "glass", "gold \"leaf\""};
  const auto at = [](double x) { return Pose{{x, 1.0 / 3, -x}, axisAngle({0, 0.6, 0.8}, x)}; };
  return {{"pane.001", plain, "glass", at(0.1), {1, 2, 3}, {-1, 0.1, 1e-300}, 301.7, true},
          {"pane.002", plain, "glass", at(-2), {-1, 2, 3}, {}, 300, true},
          {"floor", std::make_shared<const TriangleMesh>(painted), "stone", at(0), {}, {}, 300, false}};
}

inline FrameParticles sampleParticles(std::size_t count) {
  FrameParticles particles;
  for (std::uint64_t n = 0; n < count; ++n) {
    particles.position.emplace_back(sampleRandom().normal3(2 * n));
    particles.velocity.emplace_back(sampleRandom().normal3(2 * n + 1));
    particles.mass.push_back(static_cast<float>(sampleRandom().uniform(n)));
    particles.temperature.push_back(static_cast<float>(300 + 2000 * sampleRandom().uniform(n + count)));
    particles.kind.push_back(static_cast<std::uint8_t>(n % 3));
  }
  return particles;
}

inline Frame sampleFrame(int index) {
  Frame frame{index, index / 24.0, sampleGas(), sampleBodies(), sampleParticles(100), {}};
  frame.bodies[0].pose.position.x += index * 0.1;
  frame.report = {7, 0.93, 1e-7, {41, 3e-7, true}, {1, 0.5, 0.25, 0.25}, {-1e6, 2, 3, 1.0 / 3}, {{"pressure", 0.1}}};
  return frame;
}

}  // namespace brisance
