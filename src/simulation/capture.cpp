#include "simulation/capture.h"

#include <cmath>

#include "base/parallel.h"

namespace brisance {

namespace {
/// A frame's values are multiples of these, powers of two: what nobody sees need not fill a disk. Near still air they
/// are the background.
constexpr float kelvinStep = 0x1p-4f, densityStep = 0x1p-20f;  // [K], [kg/m3]

/// [m/s] Carried with it for a frame, nothing is off by more than a two-thousandth of a cell.
float velocityStep(double cellSize, double frameTime) {
  constexpr int finer = -10;
  return std::ldexp(1.0f, std::ilogb(cellSize / frameTime) + finer);
}

/// The nearest multiple. Larger numbers, which are coarser than that, stay as they are.
inline float roundTo(float step, float value) {
  const float shift = 0x1.8p23f * step;  // next to it numbers have that step
  return std::abs(value) < 0x1p22f * step ? (value + shift) - shift : value;
}

SparseGrid<float> sparse(const Grid3<float>& grid, float background, float step) {
  return makeSparse(grid, background, [&](int i, int j, int k) {
    const float value = grid(i, j, k);
    return std::abs(value - background) < step ? background : roundTo(step, value);
  });
}

SparseGrid<Vec3f> centreVelocities(const FluidState& gas, float step) {
  const MacVelocity& m = gas.velocity;
  return makeSparse(gas.pressure, Vec3f{}, [&](int i, int j, int k) {
    return Vec3f{roundTo(step, 0.5f * (m.u(i, j, k) + m.u(i + 1, j, k))),
                 roundTo(step, 0.5f * (m.v(i, j, k) + m.v(i, j + 1, k))),
                 roundTo(step, 0.5f * (m.w(i, j, k) + m.w(i, j, k + 1)))};
  });
}

std::uint8_t frameKind(const ParticleSet& p, std::size_t n) {
  if (p.kind[n] == ParticleKind::soot) return 2;
  return p.ignited[n] ? 1 : 0;
}

FrameParticles captureParticles(const ParticleSet& p) {
  FrameParticles out;
  out.position.resize(p.size());
  out.velocity.resize(p.size());
  out.mass.resize(p.size());
  out.temperature.resize(p.size());
  out.kind.resize(p.size());
  constexpr std::int64_t grain = 1 << 14;
  parallelFor(0, static_cast<std::int64_t>(p.size()), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) {
      out.position[n] = Vec3f(p.position[n]);
      out.velocity[n] = Vec3f(p.velocity[n]);
      out.mass[n] = static_cast<float>(p.mass[n]);
      out.temperature[n] = static_cast<float>(p.temperature[n]);
      out.kind[n] = frameKind(p, static_cast<std::size_t>(n));
    }
  });
  return out;
}
}  // namespace

Frame captureFrame(const WorldState& world, const SimulationSettings& settings) {
  Frame frame;
  frame.index = world.frame;
  frame.time = world.time;
  frame.report = world.report;
  const FluidState& gas = world.gas;
  frame.gas.density = sparse(gas.soot, 0, densityStep);
  frame.gas.flame = sparse(gas.flame, 0, densityStep);
  frame.gas.temperature = sparse(gas.temperature, static_cast<float>(settings.fluid.ambientTemperature), kelvinStep);
  frame.gas.velocity = centreVelocities(gas, velocityStep(settings.fluid.cellSize, settings.frameTime));
  frame.particles = captureParticles(world.particles);
  const RigidBodies& b = world.bodies;
  for (std::size_t n = 0; n < b.size(); ++n)
    frame.bodies.push_back({b.name[n],
                            b.mesh[n],
                            world.looks[n].material,
                            {b.position[n], b.orientation[n]},
                            b.linearVelocity[n],
                            b.angularVelocity[n],
                            world.looks[n].temperature,
                            world.looks[n].moves,
                            world.looks[n].shapeFrame});
  return frame;
}

}  // namespace brisance
