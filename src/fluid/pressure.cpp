#include "fluid/pressure.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "fluid/closing_sweep.h"
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

/// Solves directly for b, which is not written yet; returns what it was.
using DirectSolution = std::function<SourceNorms(CellField& field)>;

/// What is corrected, and how far.
struct Correction {
  FluidState& gas;
  const FluidSettings& settings;
  double dt, tolerance;
  const BodyPush& push;
  bool further = false;        ///< the pressure of an earlier attempt is added to
  DirectSolution direct = {};  ///< of the first correction, if there is one
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
/// rounding in the solver cannot hide. What is left is looked for in the velocity, in double precision.
class VelocityCorrection {
 public:
  VelocityCorrection(const Correction& task, CellField& field)
      : task_(task), gas_(task.gas), field_(field), sealed_(sealedRegions(gas_.solid, task.push)) {}

  /// `solve(goal)` replaces `field`, b, by x with a residual of goal |b|; where it gives up, no further correction is
  /// tried.
  template <class Solve>
  Projection run(const Solve& solve) {
    constexpr int mostPasses = 8;
    constexpr double aim = 0.7;               // of what is left to do, so that rounding does not cost another pass
    constexpr double singlePrecision = 1e-4;  // relative residual that one solution in single precision surely reaches
    int pass = 0;
    if (task_.direct) {
      begin(task_.direct(field_));
      report_.iterations = 1;
      close(pass++ == 0);
    } else {
      begin(findSource(true));
      quiet_ = quietRegions(gas_.solid, task_.push, field_);
    }
    for (bool gaveUp = false; !(obeys() || gaveUp || pass == mostPasses); ++pass) {
      if (pass > 0) findSource(false);
      const PressureReport correction = solve(std::max(aim * goal_ / left_, singlePrecision));
      report_.iterations += correction.iterations;
      gaveUp = !correction.converged;
      close(pass == 0);
    }
    return {report_, flow_ ? *flow_ : lookAtFlow(gas_)};
  }

 private:
  void begin(const SourceNorms& norms) {
    atFirst_ = left_ = norms.source;
    goal_ = std::max(task_.tolerance * atFirst_, norms.rounding);
  }
  bool obeys() {
    report_.residual = atFirst_ > 0 ? left_ / atFirst_ : 0;
    report_.converged = left_ <= goal_;
    return report_.converged;
  }
  /// Into the field, less what sealed pockets cannot obey.
  SourceNorms findSource(bool first) {
    SourceNorms norms = computeSource(gas_, field_);
    const bool refuse = first && !task_.settings.removeMeanSource && gas_.solid.bodies.empty();
    const PocketSources pockets =
        removePocketSources(gas_, sealed_, refuse, [&](int i, int j, int k) -> float& { return field_(i, j, k); });
    if (pockets.count > 0) norms.source = fieldNorm(field_);
    if (first) {
      report_.sealedPockets = pockets.count;
      report_.removedSource = pockets.removed;
    }
    return norms;
  }
  /// Takes the solution's gradient from the velocity.
  void close(bool first) {
    clearRegions(gas_.solid, quiet_, field_);
    task_.push.apply(field_, gas_);
    flow_ = closeStep(gas_, task_.settings.faces, task_.dt, field_, first && !task_.further);
    const double h = gas_.pressure.cellSize;
    left_ = report_.sealedPockets > 0 ? findSource(false).source : h * h * std::sqrt(flow_->wrong);
  }

  const Correction& task_;
  FluidState& gas_;
  CellField& field_;
  SealedRegions sealed_;
  std::vector<std::uint8_t> quiet_;
  PressureReport report_;
  double atFirst_ = 0, left_ = 0, goal_ = 0;
  std::optional<FlowFindings> flow_;
};

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

/// In a box without solids, of which gas finds a way out, nothing about b needs to be known before: it is written plane
/// by plane where it is transformed.
SourceNorms solveEmptyBox(const FluidState& gas, const BoxPoisson& box, CellField& field) {
  VelocitySource source(gas);
  box.solve(field, [&](int k, float* plane) { source.plane(k, plane, box.layout().row); });
  return source.norms();
}

Projection projectBy(const FastPoisson& s, FluidState& gas, const FluidSettings& settings, double dt,
                     PressureScratch& scratch) {
  prepareBox(gas, settings.faces, scratch);
  prepareFields(gas, scratch);
  if (gas.solid.empty)
    scratch.surface = {};
  else
    scratch.surface = findSurface(gas.solid, *scratch.box);
  addPush(pushOf(gas, settings), scratch.surface);
  Correction task{gas, settings, dt, s.tolerance, scratch.surface.push};
  if (gas.solid.empty && gas.solid.pocketCount() == 0)
    task.direct = [&](CellField& field) { return solveEmptyBox(gas, *scratch.box, field); };
  return VelocityCorrection(task, scratch.field).run([&](double goal) {
    return solveFastPoisson(*scratch.box, scratch.surface, goal, s.maxIterations, scratch.field, scratch.work,
                            scratch.surfaceVectors);
  });
}

Projection correctByMultigrid(const MultigridSolver& s, bool further, FluidState& gas, const FluidSettings& settings,
                              double dt, PressureScratch& scratch) {
  prepareFields(gas, scratch);
  const BodyPush push = pushOf(gas, settings);
  Multigrid multigrid(gas.solid, settings.faces, push);
  const Correction task{gas, settings, dt, s.tolerance, push, further};
  return VelocityCorrection(task, scratch.field).run([&](double goal) {
    return multigrid.solve(scratch.field, goal, s.maxIterations);
  });
}

Projection projectBy(const MultigridSolver& s, FluidState& gas, const FluidSettings& settings, double dt,
                     PressureScratch& scratch) {
  refusePeriodic(settings.faces, "multigrid");
  return correctByMultigrid(s, false, gas, settings, dt, scratch);
}

Projection projectBy(const ConjugateGradient& s, FluidState& gas, const FluidSettings& settings, double dt,
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
  return {report, lookAtFlow(gas)};
}

/// fast_poisson, an iteration of which costs a tenth of a multigrid one (128^3 cells, three solids); where it takes
/// so many that multigrid would have been done, multigrid goes on from there. It knows periodic faces not.
Projection projectBy(const AutomaticSolver& s, FluidState& gas, const FluidSettings& settings, double dt,
                     PressureScratch& scratch) {
  if (anyPeriodic(settings.faces)) return projectBy(FastPoisson{s.tolerance}, gas, settings, dt, scratch);
  Projection done = projectBy(FastPoisson{s.tolerance, s.patience}, gas, settings, dt, scratch);
  PressureReport& report = done.pressure;
  if (report.converged) return done;
  const MultigridSolver rest{std::min(0.5, s.tolerance / report.residual)};
  const Projection further = correctByMultigrid(rest, true, gas, settings, dt, scratch);
  report.iterations += further.pressure.iterations;
  report.residual *= further.pressure.residual;
  report.converged = further.pressure.converged;
  done.flow = further.flow;
  return done;
}
}  // namespace

Projection projectAndLook(FluidState& gas, const FluidSettings& settings, double dt, PressureScratch& scratch) {
  return std::visit([&](const auto& solver) { return projectBy(solver, gas, settings, dt, scratch); },
                    settings.pressure);
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
