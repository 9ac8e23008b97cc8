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

BrickSource<float> rounded(const Grid3<float>& grid, float background, float step) {
  return bricksOf<float>(grid, background, [=, &grid](float* values, int i, int j, int k, int count) {
    const float* row = &grid.values[grid.index(i, j, k)];
    for (int n = 0; n < count; ++n)
      values[n] = std::abs(row[n] - background) < step ? background : roundTo(step, row[n]);
  });
}

BrickSource<Vec3f> centreVelocities(const FluidState& gas, float step) {
  const MacVelocity& m = gas.velocity;
  return bricksOf<Vec3f>(gas.pressure, Vec3f{}, [step, &m](Vec3f* values, int i, int j, int k, int count) {
    const float *u = &m.u(i, j, k), *v = &m.v(i, j, k), *vAbove = &m.v(i, j + 1, k);
    const float *w = &m.w(i, j, k), *wBehind = &m.w(i, j, k + 1);
    for (int n = 0; n < count; ++n)
      values[n] = {roundTo(step, 0.5f * (u[n] + u[n + 1])), roundTo(step, 0.5f * (v[n] + vAbove[n])),
                   roundTo(step, 0.5f * (w[n] + wBehind[n]))};
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

GasSource gasOf(const WorldState& world, const SimulationSettings& settings) {
  const FluidState& gas = world.gas;
  return {rounded(gas.soot, 0, densityStep),
          rounded(gas.temperature, static_cast<float>(settings.fluid.ambientTemperature), kelvinStep),
          rounded(gas.flame, 0, densityStep),
          centreVelocities(gas, velocityStep(settings.fluid.cellSize, settings.frameTime))};
}

Frame captureWithoutGas(const WorldState& world) {
  Frame frame;
  frame.index = world.frame;
  frame.time = world.time;
  frame.report = world.report;
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

Frame captureFrame(const WorldState& world, const SimulationSettings& settings) {
  Frame frame = captureWithoutGas(world);
  const GasSource gas = gasOf(world, settings);
  frame.gas = {makeSparse(gas.density), makeSparse(gas.temperature), makeSparse(gas.flame), makeSparse(gas.velocity)};
  return frame;
}

}  // namespace brisance
