// The gas against flows of textbooks, as curves.
#include <array>
#include <cmath>

#include "assets/figures.h"
#include "assets/plot.h"
#include "assets/textbook_flows.h"

namespace brisance::assets {
namespace {
using namespace textbook;

struct NamedScheme {
  const char* name;
  AdvectionScheme scheme;
  Stroke stroke;
};
const std::array<NamedScheme, 4> schemes{{{"central", DonorCell{0}, {"#2f6db3", 1.8}},
                                          {"maccormack", MacCormack{}, {"#c2571a", 1.8}},
                                          {"donor_cell", DonorCell{1}, {"#3a8a4f", 1.8}},
                                          {"semi_lagrangian", SemiLagrangian{}, {"#7a4fa3", 1.8}}}};
const Stroke exactStroke{"#1d232b", 1.4, true};
constexpr double courant = 0.8;

VortexResult vortexAt(int cells, const AdvectionScheme& scheme, double wind, double time) {
  const Vec3d carried{wind, 0.3 * wind, 0};
  const int steps = static_cast<int>(std::ceil(time * cells * (2 + carried.x + carried.y) / courant));
  return runVortex({cells, scheme, 0.01, carried, time, steps});
}

struct CavityRun {
  int reynolds;
  Stroke stroke;
  CavityProfiles profiles;
};
std::array<CavityRun, 2> cavityRuns() {
  std::array<CavityRun, 2> runs{{{100, {"#2f6db3", 1.8}, {}}, {400, {"#c2571a", 1.8}, {}}}};
  for (CavityRun& run : runs) run.profiles = runCavity({64, MacCormack{}, double(run.reynolds)});
  return runs;
}

}  // namespace

CavityFigures cavityFigures() {
  Plot u({"u / lid", -0.4, 1, {-0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8, 1}}, {"y at x = 1/2", 0, 1, {0, 0.25, 0.5, 0.75, 1}});
  Plot v({"x at y = 1/2", 0, 1, {0, 0.25, 0.5, 0.75, 1}}, {"v / lid", -0.5, 0.4, {-0.4, -0.2, 0, 0.2, 0.4}});
  for (const CavityRun& run : cavityRuns()) {
    std::vector<Vec2d> across, table;
    for (const Vec2d& point : run.profiles.u) across.push_back({point.y, point.x});
    for (const Vec2d& point : ghia(run.reynolds).u) table.push_back({point.y, point.x});
    u.curve(across, run.stroke);
    u.dots(table, run.stroke.colour);
    v.curve(run.profiles.v, run.stroke);
    v.dots(ghia(run.reynolds).v, run.stroke.colour);
    u.name("Re = " + std::to_string(run.reynolds), run.stroke, 0.06);
    v.name("Re = " + std::to_string(run.reynolds), run.stroke, 0.68);
  }
  u.nameDots("Ghia et al.", "#1d232b", 0.06);
  v.nameDots("Ghia et al.", "#1d232b", 0.68);
  return {u.drawing(), v.drawing()};
}

FlatDrawing vortexDecayFigure() {
  constexpr int cells = 32;
  constexpr double end = 1.0, viscosity = 0.01;
  Plot plot({"seconds", 0, end, {0, 0.25, 0.5, 0.75, 1}}, {"speed left", 0.2, 1, {0.2, 0.4, 0.6, 0.8, 1}});
  const auto exact = [](double time) { return std::exp(-8 * pi * pi * viscosity * time); };
  for (const NamedScheme& scheme : schemes) {
    std::vector<Vec2d> left{{0, 1}};
    for (double time = 0.1; time < end + 0.01; time += 0.1)
      left.push_back({time, exact(time) * vortexAt(cells, scheme.scheme, 0, time).decay});
    plot.curve(left, scheme.stroke);
    plot.name(scheme.name, scheme.stroke, 0.6);
  }
  std::vector<Vec2d> curve;
  for (int n = 0; n <= 50; ++n) curve.push_back({end * n / 50, exact(end * n / 50)});
  plot.curve(curve, exactStroke);
  plot.name("exact", exactStroke, 0.6);
  return plot.drawing();
}

FlatDrawing gasOrderFigure() {
  Plot plot({"cells along a side", 8, 128, {8, 16, 32, 64, 128}, true},
            {"error [m/s]", 1e-4, 1, {1e-4, 1e-3, 1e-2, 1e-1, 1}, true});
  for (const NamedScheme& scheme : schemes) {
    std::vector<Vec2d> errors;
    for (const int cells : {8, 16, 32, 64, 128})
      errors.push_back({double(cells), vortexAt(cells, scheme.scheme, 0.5, 0.2).meanError});
    plot.curve(errors, scheme.stroke);
    plot.dots(errors, scheme.stroke.colour);
    plot.name(scheme.name, scheme.stroke, 0.62);
  }
  std::vector<Vec2d> poisson;
  for (const int cells : {8, 16, 32, 64, 128}) poisson.push_back({double(cells), poissonError(cells)});
  const Stroke pressure{"#8a6d1a", 1.8};
  plot.curve(poisson, pressure);
  plot.dots(poisson, pressure.colour);
  plot.name("pressure", pressure, 0.62);
  plot.curve(std::vector<Vec2d>{{8, 0.2}, {128, 0.2 / 256}}, exactStroke);
  plot.name("second order", exactStroke, 0.62);
  return plot.drawing();
}

}  // namespace brisance::assets
