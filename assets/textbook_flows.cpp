#include "assets/textbook_flows.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "fluid/fluid_step.h"
#include "fluid/solid_fractions.h"

namespace brisance::textbook {

namespace {
template <class Speed>
void setSpeed(Grid3<float>& grid, const Speed& speed) {
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) grid(i, j, k) = static_cast<float>(speed(grid.position(i, j, k)));
}

FluidSettings unitBox(const Vec3i& cells, const AdvectionScheme& scheme) {
  FluidSettings s;
  s.cells = cells;
  s.cellSize = 1.0 / cells.x;
  s.advection = scheme;
  s.coolingRate = 0;
  return s;
}

constexpr int thin = 2;  // cells across a plane flow

/// Exact speed along x of the vortex at a time.
double vortexSpeed(const Vortex& vortex, const Vec3d& p, double t) {
  const double decay = std::exp(-8 * pi * pi * vortex.viscosity * t);
  const Vec3d q = (p - vortex.wind * t) * (2 * pi);
  return vortex.wind.x + std::sin(q.x) * std::cos(q.y) * decay;
}

VortexResult compare(const Vortex& vortex, const Grid3<float>& u) {
  double sum = 0, exactSum = 0, absolute = 0;
  VortexResult result;
  const int n = vortex.cells;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double exact = vortexSpeed(vortex, u.position(i, j, 0), vortex.time), error = std::abs(u(i, j, 0) - exact);
      sum += (u(i, j, 0) - vortex.wind.x) * (u(i, j, 0) - vortex.wind.x);
      exactSum += (exact - vortex.wind.x) * (exact - vortex.wind.x);
      absolute += error;
      result.largestError = std::max(result.largestError, error);
    }
  result.decay = std::sqrt(sum / exactSum);
  result.meanError = absolute / (n * n);
  return result;
}

double largestChange(const MacVelocity& a, const MacVelocity& b) {
  double largest = 0;
  for (int axis = 0; axis < 2; ++axis)
    for (std::size_t n = 0; n < a.component(axis).values.size(); ++n)
      largest = std::max(largest, std::abs(double(a.component(axis).values[n]) - b.component(axis).values[n]));
  return largest;
}

CavityProfiles profilesOf(const MacVelocity& velocity) {
  const int n = velocity.cells().x;
  CavityProfiles profiles;
  profiles.u.push_back({0, 0});
  profiles.v.push_back({0, 0});
  for (int j = 0; j < n; ++j) {
    const double place = (j + 0.5) / n;
    profiles.u.push_back({place, velocity.u(n / 2, j, 0)});
    profiles.v.push_back({place, velocity.v(j, n / 2, 0)});
  }
  profiles.u.push_back({1, 1});
  profiles.v.push_back({1, 0});
  return profiles;
}

// Tables I and II of Ghia, Ghia & Shin 1982.
constexpr Vec2d u100[] = {{.0547, -.03717}, {.0625, -.04192}, {.0703, -.04775}, {.1016, -.06434}, {.1719, -.10150},
                          {.2813, -.15662}, {.4531, -.21090}, {.5000, -.20581}, {.6172, -.13641}, {.7344, .00332},
                          {.8516, .23151},  {.9531, .68717},  {.9609, .73722},  {.9688, .78871},  {.9766, .84123}};
constexpr Vec2d v100[] = {{.0625, .09233},  {.0703, .10091},  {.0781, .10890},  {.0938, .12317},  {.1563, .16077},
                          {.2266, .17507},  {.2344, .17527},  {.5000, .05454},  {.8047, -.24533}, {.8594, -.22445},
                          {.9063, -.16914}, {.9453, -.10313}, {.9531, -.08864}, {.9609, -.07391}, {.9688, -.05906}};
constexpr Vec2d u400[] = {{.0547, -.08186}, {.0625, -.09266}, {.0703, -.10338}, {.1016, -.14612}, {.1719, -.24299},
                          {.2813, -.32726}, {.4531, -.17119}, {.5000, -.11477}, {.6172, .02135},  {.7344, .16256},
                          {.8516, .29093},  {.9531, .55892},  {.9609, .61756},  {.9688, .68439},  {.9766, .75837}};
constexpr Vec2d v400[] = {{.0625, .18360},  {.0703, .19713},  {.0781, .20920},  {.0938, .22965},  {.1563, .28124},
                          {.2266, .30203},  {.2344, .30174},  {.5000, .05186},  {.8047, -.38598}, {.8594, -.44993},
                          {.9453, -.22847}, {.9531, -.19254}, {.9609, -.15663}, {.9688, -.12146}};
}  // namespace

VortexResult runVortex(const Vortex& vortex) {
  FluidSettings s = unitBox({vortex.cells, vortex.cells, thin}, vortex.scheme);
  s.faces.fill(FaceKind::periodic);
  s.viscosity = vortex.viscosity;
  FluidState gas = makeFluid(s, stampSolids(s, {}), 1);
  setSpeed(gas.velocity.u, [&](const Vec3d& p) { return vortexSpeed(vortex, p, 0); });
  setSpeed(gas.velocity.v,
           [&](const Vec3d& p) { return vortex.wind.y - std::cos(2 * pi * p.x) * std::sin(2 * pi * p.y); });
  const ThreadLimit one(1);  // too little work for more
  FluidScratch scratch;
  for (int step = 0; step < vortex.steps; ++step) stepFluid(gas, s, 1, vortex.time / vortex.steps, scratch);
  return compare(vortex, gas.velocity.u);
}

CavityProfiles runCavity(const Cavity& cavity) {
  FluidSettings s = unitBox({cavity.cells, cavity.cells, thin}, cavity.scheme);
  s.faces = {FaceKind::noSlip, FaceKind::noSlip,   FaceKind::noSlip,
             FaceKind::noSlip, FaceKind::periodic, FaceKind::periodic};
  s.wallVelocity[3] = {1, 0, 0};
  s.viscosity = 1 / cavity.reynolds;
  s.courant = cavity.courant;
  FluidState gas = makeFluid(s, stampSolids(s, {}), 1);
  const ThreadLimit one(1);
  FluidScratch scratch;
  constexpr double steady = 5e-4;  // [m/s2]
  double time = 0, change = 1;
  int steps = 0;
  for (; time < cavity.longestTime && change > steady; ++steps) {
    const double dt = std::min(longestStep(gas, s, 0), s.courant * s.cellSize);
    const MacVelocity before = gas.velocity;
    stepFluid(gas, s, 1, dt, scratch);
    change = largestChange(before, gas.velocity) / dt;
    time += dt;
  }
  CavityProfiles profiles = profilesOf(gas.velocity);
  profiles.steps = steps;
  profiles.time = time;
  profiles.change = change;
  return profiles;
}

GhiaTable ghia(int reynolds) { return reynolds == 100 ? GhiaTable{u100, v100} : GhiaTable{u400, v400}; }

double along(std::span<const Vec2d> profile, double place) {
  std::size_t n = 1;
  while (n + 1 < profile.size() && profile[n].x < place) ++n;
  const Vec2d a = profile[n - 1], b = profile[n];
  return a.y + (b.y - a.y) * (place - a.x) / (b.x - a.x);
}

double farthest(std::span<const Vec2d> profile, std::span<const Vec2d> table) {
  double largest = 0;
  for (const Vec2d& point : table) largest = std::max(largest, std::abs(along(profile, point.x) - point.y));
  return largest;
}

double poissonError(int cells) {
  // The gradient of q = sin(3 pi x) sin(pi y) sin(pi z), which is 0 on all open faces, is what pressure takes away:
  // three waves along x and one across, as a wave alike in all directions has no error.
  const FluidSettings s = unitBox({cells, cells, cells}, DonorCell{});
  FluidState gas = makeFluid(s, stampSolids(s, {}), 1);
  const double k[3] = {3 * pi, pi, pi};
  for (int axis = 0; axis < 3; ++axis)
    setSpeed(gas.velocity.component(axis), [&](const Vec3d& p) {
      double product = k[axis];
      for (int a = 0; a < 3; ++a) product *= a == axis ? std::cos(k[a] * p[a]) : std::sin(k[a] * p[a]);
      return product;
    });
  PressureScratch scratch;
  project(gas, s, 1, scratch);
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, largestMagnitude(gas.velocity.component(axis)));
  return largest;
}

}  // namespace brisance::textbook
