#include "simulation/capture.h"

#include <cmath>

namespace brisance {

namespace {
/// Values closer to the background than this are the background: still air need not fill a disk.
struct Quiet {
  static constexpr float kelvin = 0.05f;
  static constexpr float density = 1e-6f;   // [kg/m3]
  static constexpr float velocity = 1e-4f;  // [m/s]
};

SparseGrid<float> sparse(const Grid3<float>& grid, float background, float quiet) {
  Grid3<float> snapped = grid;
  for (float& value : snapped.values)
    if (std::abs(value - background) < quiet) value = background;
  return makeSparse(snapped, background);
}

SparseGrid<Vec3f> centreVelocities(const FluidState& gas) {
  const MacVelocity& m = gas.velocity;
  Grid3<Vec3f> centre(gas.pressure.size, gas.pressure.origin, gas.pressure.cellSize);
  for (int k = 0; k < centre.size.z; ++k)
    for (int j = 0; j < centre.size.y; ++j)
      for (int i = 0; i < centre.size.x; ++i) {
        const Vec3f v{0.5f * (m.u(i, j, k) + m.u(i + 1, j, k)), 0.5f * (m.v(i, j, k) + m.v(i, j + 1, k)),
                      0.5f * (m.w(i, j, k) + m.w(i, j, k + 1))};
        if (length(v) >= Quiet::velocity) centre(i, j, k) = v;
      }
  return makeSparse(centre, Vec3f{});
}

std::uint8_t frameKind(const ParticleSet& p, std::size_t n) {
  if (p.kind[n] == ParticleKind::soot) return 2;
  return p.ignited[n] ? 1 : 0;
}

FrameParticles captureParticles(const ParticleSet& p) {
  FrameParticles out;
  for (std::size_t n = 0; n < p.size(); ++n) {
    out.position.emplace_back(p.position[n]);
    out.velocity.emplace_back(p.velocity[n]);
    out.mass.push_back(static_cast<float>(p.mass[n]));
    out.temperature.push_back(static_cast<float>(p.temperature[n]));
    out.kind.push_back(frameKind(p, n));
  }
  return out;
}
}  // namespace

Frame captureFrame(const WorldState& world, const SimulationSettings& settings) {
  Frame frame;
  frame.index = world.frame;
  frame.time = world.time;
  frame.report = world.report;
  const FluidState& gas = world.gas;
  frame.gas.density = sparse(gas.soot, 0, Quiet::density);
  frame.gas.flame = sparse(gas.flame, 0, Quiet::density);
  frame.gas.temperature = sparse(gas.temperature, static_cast<float>(settings.fluid.ambientTemperature), Quiet::kelvin);
  frame.gas.velocity = centreVelocities(gas);
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
                            world.looks[n].moves});
  return frame;
}

}  // namespace brisance
