#include "fluid/pressure.h"

#include <algorithm>
#include <cmath>

#include "base/lane_sum.h"
#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/multigrid.h"
#include "fluid/projection.h"

namespace brisance {

namespace {
void prepareBox(const FluidState& gas, const Faces& faces, PressureScratch& scratch) {
  const bool fits = scratch.box && scratch.box->layout().cells == gas.pressure.size && scratch.box->faces() == faces;
  if (!fits) scratch.box.emplace(gas.pressure.size, faces);
}

void prepareFields(const FluidState& gas, PressureScratch& scratch) {
  const CellLayout layout(gas.pressure.size);
  for (CellField* field : {&scratch.field, &scratch.work})
    if (!(field->layout == layout)) *field = CellField(layout);
}

/// What is corrected, and how far.
struct Correction {
  FluidState& gas;
  const FluidSettings& settings;
  double dt, tolerance;
  const BodyPush& push;
  bool further = false;  ///< the pressure of an earlier attempt is added to
};

/// Spaces that only a source of sum zero suits: a body that gives way would be one's way out.
SealedRegions sealedRegions(const SolidStamp& solid, const BodyPush& push) {
  SealedRegions sealed = solid.sealed;
  for (std::size_t n = 0; n < sealed.size(); ++n)
    if (!push.empty() && push.yielding()[n]) sealed[n] = 0;
  return sealed;
}

/// Regions in which nothing is to be done; nothing shall be, however coarsely the others are solved.
std::vector<std::uint8_t> quietRegions(const SolidStamp& solid, const BodyPush& push, const CellField& b) {
  const std::size_t count = solid.sealed.size();
  std::vector<std::uint8_t> quiet(count, 1);
  if (count == 1) return {0};
  const Vec3i n = solid.region.size;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i)
        if (b(i, j, k) != 0 && solid.region(i, j, k) >= 0) quiet[solid.region(i, j, k)] = 0;
  for (std::size_t r = 0; r < count; ++r)  // a body carries the push from one region to the next
    if (!push.empty() && push.touches(static_cast<int>(r))) quiet[r] = 0;
  return quiet;
}

void clearRegions(const SolidStamp& solid, const std::vector<std::uint8_t>& quiet, CellField& x) {
  if (std::find(quiet.begin(), quiet.end(), 1) == quiet.end()) return;
  const Vec3i n = solid.region.size;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i)
        if (const int region = solid.region(i, j, k); region >= 0 && quiet[region]) x(i, j, k) = 0;
}

/// Makes the velocity obey by corrections, each from the divergence that the velocity itself still has, so that
/// rounding in the solver cannot hide. `solve(goal)` replaces `field`, b, by x with a residual of goal |b|; where it
/// gives up, no further correction is tried.
template <class Solve>
PressureReport correctVelocity(const Correction& task, CellField& field, const Solve& solve) {
  constexpr int mostPasses = 8;
  constexpr double aim = 0.7;               // of what is left to do, so that rounding does not cost another pass
  constexpr double singlePrecision = 1e-4;  // relative residual that one solution in single precision surely reaches
  FluidState& gas = task.gas;
  const SealedRegions sealed = sealedRegions(gas.solid, task.push);
  const bool refuse = !task.settings.removeMeanSource && gas.solid.bodies.empty();
  std::vector<std::uint8_t> quiet;
  PressureReport report;
  double atFirst = 0;
  bool gaveUp = false;
  for (int pass = 0;; ++pass) {
    const SourceNorms norms = computeSource(gas, field);
    if (pass == 0) quiet = quietRegions(gas.solid, task.push, field);
    const PocketSources pockets = removePocketSources(gas, sealed, refuse && pass == 0,
                                                      [&](int i, int j, int k) -> float& { return field(i, j, k); });
    const double left = pockets.count > 0 ? fieldNorm(field) : norms.source;
    if (pass == 0) {
      atFirst = left;
      report.sealedPockets = pockets.count;
      report.removedSource = pockets.removed;
    }
    const double goal = std::max(task.tolerance * atFirst, norms.rounding);
    report.residual = atFirst > 0 ? left / atFirst : 0;
    report.converged = left <= goal;
    if (report.converged || gaveUp || pass == mostPasses) return report;
    const PressureReport correction = solve(std::max(aim * goal / left, singlePrecision));
    report.iterations += correction.iterations;
    gaveUp = !correction.converged;
    clearRegions(gas.solid, quiet, field);
    task.push.apply(field, gas);
    subtractGradient(gas, task.settings.faces, task.dt, field, pass == 0 && !task.further);
  }
}

BodyPush pushOf(const FluidState& gas, const FluidSettings& settings) {
  return gas.solid.bodies.empty() ? BodyPush() : BodyPush(gas.solid, CellLayout(gas.pressure.size), settings.density);
}

bool anyPeriodic(const Faces& faces) {
  return std::find(faces.begin(), faces.end(), FaceKind::periodic) != faces.end();
}

void refusePeriodic(const Faces& faces, const char* solver) {
  if (anyPeriodic(faces))
    throw InputError(fmt::format("gas.pressure.type: {} does not know periodic faces: use fast_poisson", solver));
}

PressureReport projectBy(const FastPoisson& s, FluidState& gas, const FluidSettings& settings, double dt,
                         PressureScratch& scratch) {
  prepareBox(gas, settings.faces, scratch);
  prepareFields(gas, scratch);
  if (gas.solid.empty)
    scratch.surface = {};
  else
    scratch.surface = findSurface(gas.solid, *scratch.box);
  addPush(pushOf(gas, settings), scratch.surface);
  return correctVelocity({gas, settings, dt, s.tolerance, scratch.surface.push}, scratch.field, [&](double goal) {
    return solveFastPoisson(*scratch.box, scratch.surface, goal, s.maxIterations, scratch.field, scratch.work,
                            scratch.surfaceVectors);
  });
}

PressureReport correctByMultigrid(const MultigridSolver& s, bool further, FluidState& gas,
                                  const FluidSettings& settings, double dt, PressureScratch& scratch) {
  prepareFields(gas, scratch);
  const BodyPush push = pushOf(gas, settings);
  Multigrid multigrid(gas.solid, settings.faces, push);
  return correctVelocity({gas, settings, dt, s.tolerance, push, further}, scratch.field,
                         [&](double goal) { return multigrid.solve(scratch.field, goal, s.maxIterations); });
}

PressureReport projectBy(const MultigridSolver& s, FluidState& gas, const FluidSettings& settings, double dt,
                         PressureScratch& scratch) {
  refusePeriodic(settings.faces, "multigrid");
  return correctByMultigrid(s, false, gas, settings, dt, scratch);
}

PressureReport projectBy(const ConjugateGradient& s, FluidState& gas, const FluidSettings& settings, double dt,
                         PressureScratch& scratch) {
  refusePeriodic(settings.faces, "conjugate_gradient");
  if (!pushOf(gas, settings).empty())
    throw InputError("gas.pressure.type: conjugate_gradient does not push bodies: use auto");
  ConjugateGradientScratch& vectors = scratch.conjugateGradient;
  startConjugateGradient(gas, dt, vectors);
  const PocketSources pockets =
      removePocketSources(gas, gas.solid.sealed, !settings.removeMeanSource && gas.solid.bodies.empty(),
                          [&](int i, int j, int k) -> double& { return vectors.r(i + 1, j + 1, k + 1); });
  const PressureOperator op = makePressureOperator(gas.solid, settings.faces);
  PressureReport report = solveConjugateGradient(op, s, vectors);
  report.sealedPockets = pockets.count;
  report.removedSource = pockets.removed;
  applySolution(gas, op, dt, vectors);
  return report;
}

/// fast_poisson, an iteration of which costs a seventh of a multigrid one (128^3 cells, three solids); where it takes
/// so many that multigrid would have been done, multigrid goes on from there. It knows periodic faces not.
PressureReport projectBy(const AutomaticSolver& s, FluidState& gas, const FluidSettings& settings, double dt,
                         PressureScratch& scratch) {
  if (anyPeriodic(settings.faces)) return projectBy(FastPoisson{s.tolerance}, gas, settings, dt, scratch);
  PressureReport report = projectBy(FastPoisson{s.tolerance, s.patience}, gas, settings, dt, scratch);
  if (report.converged) return report;
  const MultigridSolver rest{std::min(0.5, s.tolerance / report.residual)};
  const PressureReport further = correctByMultigrid(rest, true, gas, settings, dt, scratch);
  report.iterations += further.iterations;
  report.residual *= further.residual;
  report.converged = further.converged;
  return report;
}
}  // namespace

PressureReport project(FluidState& gas, const FluidSettings& settings, double dt, PressureScratch& scratch) {
  return std::visit([&](const auto& solver) { return projectBy(solver, gas, settings, dt, scratch); },
                    settings.pressure);
}

Continuity continuityOf(const FluidState& gas) {
  const Vec3i n = gas.pressure.size;
  const double perLength = 1 / gas.pressure.cellSize;
  struct Sums {
    double error = 0, source = 0, created = 0;
  };
  std::vector<Sums> planes(n.z);
  const auto addRow = [&](int j, int k, Sums& sums) {
    const MacVelocity& m = gas.velocity;
    const float *u = &m.u(0, j, k), *v = &m.v(0, j, k), *vUpper = &m.v(0, j + 1, k);
    const float *w = &m.w(0, j, k), *wUpper = &m.w(0, j, k + 1), *phi = &gas.divergence(0, j, k);
    const std::uint8_t* inside = &gas.solid.inside(0, j, k);
    sums.error += laneSum(n.x, [&](std::int64_t i) {
      const double flow = (double(u[i + 1]) - u[i]) + (double(vUpper[i]) - v[i]) + (double(wUpper[i]) - w[i]);
      const double wrong = flow * perLength - phi[i];
      return inside[i] ? 0 : wrong * wrong;
    });
    sums.source += laneSum(n.x, [&](std::int64_t i) {
      const double source = double(phi[i]) * phi[i];
      return inside[i] ? 0 : source;
    });
    sums.created += laneSum(n.x, [&](std::int64_t i) {
      const float source = phi[i];
      return inside[i] ? 0 : source;
    });
  };
  parallelFor(0, n.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      runWide([&] {
        for (int j = 0; j < n.y; ++j) addRow(j, k, planes[k]);
      });
  });
  Sums all;
  for (const Sums& plane : planes) {
    all.error += plane.error;
    all.source += plane.source;
    all.created += plane.created;
  }
  const double h = gas.pressure.cellSize;
  return {std::sqrt(all.error) / (all.source > 0 ? std::sqrt(all.source) : 1), all.created * h * h * h};
}

double outwardVolume(const FluidState& gas, const FluidSettings& settings) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Grid3<float>& speed = gas.velocity.component(axis);
    const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
    const std::int64_t far = (speed.size[axis] - 1) * speed.stride(axis);
    for (int q = 0; q < speed.size[c]; ++q)
      for (int p = 0; p < speed.size[b]; ++p) {
        const std::int64_t at = p * speed.stride(b) + q * speed.stride(c);
        sum += double(speed.values[at + far]) - speed.values[at];
      }
  }
  return sum * settings.cellSize * settings.cellSize;
}

}  // namespace brisance
