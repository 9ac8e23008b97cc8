#include "view/moment_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace brisance {

using nlohmann::json;

namespace {

json asJson(const Vec3d& v) { return {v.x, v.y, v.z}; }

/// A share -1 .. 1 in 16 bits.
std::int16_t shortOf(double share) {
  return static_cast<std::int16_t>(std::lround(32767 * std::clamp(share, -1., 1.)));
}

/// Of each kind of particle (0 fuel that does not burn, 1 fuel that burns, 2 soot) at most so many are shown.
constexpr std::array<std::size_t, 3> mostPoints{600, 1200, 600};

/// Every so many of each kind.
std::vector<std::size_t> chosenParticles(const FrameParticles& particles) {
  std::array<std::size_t, 3> count{}, met{};
  for (const std::uint8_t kind : particles.kind) ++count.at(kind);
  std::vector<std::size_t> chosen;
  for (std::size_t p = 0; p < particles.kind.size(); ++p) {
    const std::uint8_t kind = particles.kind[p];
    const std::size_t stride = (count[kind] + mostPoints[kind] - 1) / mostPoints[kind];
    if (met[kind]++ % stride == 0) chosen.push_back(p);
  }
  return chosen;
}

Box3 boxOf(const FrameParticles& particles, const std::vector<std::size_t>& chosen) {
  Box3 box;
  for (const std::size_t p : chosen) box.include(Vec3d(particles.position[p]));
  return box;
}

json balanceOf(const Balance& balance) {
  return {{"in", balance.in},
          {"gained", balance.gained},
          {"out", balance.out},
          {"lost", balance.lost},
          {"error", balance.error()}};
}

}  // namespace

json addPoses(const std::vector<FrameBody>& bodies, const std::map<std::string, std::size_t>& places,
              MomentArrays& arrays) {
  const std::size_t n = places.size();
  std::vector<float> position(3 * n), speed(n), temperature(n);
  std::vector<std::int16_t> orientation(4 * n);
  std::vector<std::int16_t> shape(n, -1);
  for (const FrameBody& body : bodies) {
    const auto found = places.find(body.name);
    if (found == places.end()) continue;
    const std::size_t at = found->second;
    const Quaternion q = normalized(body.pose.orientation);
    for (int axis = 0; axis < 3; ++axis) position[axis * n + at] = static_cast<float>(body.pose.position[axis]);
    const double turn[] = {q.x, q.y, q.z, q.w};
    for (int part = 0; part < 4; ++part) orientation[part * n + at] = shortOf(turn[part]);
    speed[at] = static_cast<float>(length(body.linearVelocity));
    temperature[at] = static_cast<float>(body.temperature);
    shape[at] = static_cast<std::int16_t>(body.shapeFrame);
  }
  return {{"count", n},
          {"position", arrays.add(position)},
          {"orientation", arrays.add(orientation)},
          {"speed", arrays.add(speed)},
          {"temperature", arrays.add(temperature)},
          {"shape", arrays.add(shape)}};
}

json addPoints(const FrameParticles& particles, const HeatScale& scale, MomentArrays& arrays) {
  const std::vector<std::size_t> chosen = chosenParticles(particles);
  const std::size_t n = chosen.size();
  if (n == 0) return {{"count", 0}};
  const Box3 box = boxOf(particles, chosen);
  const Vec3d extent = max(box.upper - box.lower, Vec3d(1e-9, 1e-9, 1e-9));
  std::vector<std::uint16_t> position;
  std::vector<std::uint8_t> heat, kind;
  for (const std::size_t p : chosen) {
    const Vec3d place = Vec3d(particles.position[p]) - box.lower;
    for (int axis = 0; axis < 3; ++axis)
      position.push_back(static_cast<std::uint16_t>(std::lround(65535 * place[axis] / extent[axis])));
    heat.push_back(scale.ofTemperature(particles.temperature[p]));
    kind.push_back(particles.kind[p]);
  }
  return {{"count", n},
          {"of", particles.kind.size()},
          {"lower", asJson(box.lower)},
          {"extent", asJson(extent)},
          {"position", arrays.add(position)},
          {"heat", arrays.add(heat)},
          {"kind", arrays.add(kind)}};
}

json addGas(const CompactGas& gas, MomentArrays& arrays) {
  return {{"size", {gas.size.x, gas.size.y, gas.size.z}},
          {"origin", asJson(gas.origin)},
          {"cell", gas.cellSize},
          {"densityLevels", densityLevels},
          {"heatLevels", heatLevels},
          {"density", arrays.add(residuals(gas.density, gas.size))},
          {"heat", arrays.add(residuals(gas.heat, gas.density, gas.size))}};
}

json reportOf(const StepReport& report) {
  return {{"substeps", report.substeps},        {"courant", report.courant},
          {"divergence", report.divergence},    {"iterations", report.pressure.iterations},
          {"volume", balanceOf(report.volume)}, {"heat", balanceOf(report.heat)},
          {"seconds", report.stageSeconds}};
}

}  // namespace brisance
