#include "fluid/pressure.h"

#include <cmath>

#include "base/parallel.h"
#include "base/vector_path.h"

namespace brisance {

namespace {
constexpr int lanes =
    8;  ///< partial sums of a dot product: a fixed number, so that its bits do not depend on vector width

double total(const double (&sums)[lanes]) {
  return ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]));
}

/// Adds term(i) for i in [0, count) to the lanes i % 8.
template <class Term>
void addLanes(double (&sums)[lanes], int count, const Term& term) {
  int i = 0;
  for (; i + lanes <= count; i += lanes)
    for (int lane = 0; lane < lanes; ++lane) sums[lane] += term(i + lane);
  for (; i < count; ++i) sums[i % lanes] += term(i);
}

/// Sum over all rows (j, k) of rowSum, one slab of constant k at a time, in fixed order.
template <class RowSum>
double sumRows(const Vec3i& cells, const RowSum& rowSum) {
  return parallelSum(cells.z, 1, [&](std::int64_t first, std::int64_t last) {
    double sums[lanes] = {};
    for (int k = static_cast<int>(first); k < last; ++k)
      runWide([&] {
        for (int j = 0; j < cells.y; ++j) rowSum(sums, j, k);
      });
    return total(sums);
  });
}

double* row(Grid3<double>& padded, int j, int k) { return padded.values.data() + padded.index(1, j + 1, k + 1); }

/// q = A d, returning d . q
double applyOperator(const PressureOperator& op, Grid3<double>& direction, Grid3<double>& product) {
  const std::int64_t dy = direction.stride(1), dz = direction.stride(2);
  return sumRows(op.cells, [&](double(&sums)[lanes], int j, int k) {
    const double* d = row(direction, j, k);
    double* q = row(product, j, k);
    const float* u = &op.share.u(0, j, k);
    const float* v = &op.share.v(0, j, k);
    const float* vUpper = &op.share.v(0, j + 1, k);
    const float* w = &op.share.w(0, j, k);
    const float* wUpper = &op.share.w(0, j, k + 1);
    for (int i = 0; i < op.cells.x; ++i) {
      const double c = d[i];
      q[i] = (double(u[i]) * (c - d[i - 1]) + double(u[i + 1]) * (c - d[i + 1])) +
             (double(v[i]) * (c - d[i - dy]) + double(vUpper[i]) * (c - d[i + dy])) +
             (double(w[i]) * (c - d[i - dz]) + double(wUpper[i]) * (c - d[i + dz]));
    }
    addLanes(sums, op.cells.x, [&](int i) { return d[i] * q[i]; });
  });
}

double squaredNorm(const Vec3i& cells, Grid3<double>& vector) {
  return sumRows(cells, [&](double(&sums)[lanes], int j, int k) {
    const double* x = row(vector, j, k);
    addLanes(sums, cells.x, [&](int i) { return x[i] * x[i]; });
  });
}

/// a += factor * b, returning |a|^2
double addScaled(const Vec3i& cells, Grid3<double>& a, double factor, Grid3<double>& b) {
  return sumRows(cells, [&](double(&sums)[lanes], int j, int k) {
    double* x = row(a, j, k);
    const double* y = row(b, j, k);
    for (int i = 0; i < cells.x; ++i) x[i] += factor * y[i];
    addLanes(sums, cells.x, [&](int i) { return x[i] * x[i]; });
  });
}

/// d = r + beta d
void turnDirection(const Vec3i& cells, Grid3<double>& direction, double beta, Grid3<double>& residual) {
  parallelFor(0, cells.z, 1, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      runWide([&] {
        for (int j = 0; j < cells.y; ++j) {
          double* d = row(direction, j, k);
          const double* r = row(residual, j, k);
          for (int i = 0; i < cells.x; ++i) d[i] = r[i] + beta * d[i];
        }
      });
  });
}

double divergence(const MacVelocity& m, int i, int j, int k) {
  return (double(m.u(i + 1, j, k)) - m.u(i, j, k)) + (double(m.v(i, j + 1, k)) - m.v(i, j, k)) +
         (double(m.w(i, j, k + 1)) - m.w(i, j, k));
}

void resize(PressureScratch& scratch, const FluidState& gas) {
  const Vec3i n = gas.pressure.size;
  const Vec3i padded{n.x + 2, n.y + 2, n.z + 2};
  if (scratch.x.size == padded) return;
  for (Grid3<double>* vector : {&scratch.x, &scratch.r, &scratch.d, &scratch.q})
    *vector =
        Grid3<double>(padded, gas.pressure.origin - Vec3d(1, 1, 1) * gas.pressure.cellSize, gas.pressure.cellSize, 0.0);
}

/// b = h^2 (phi - div u), and as the start the last pressure times dt.
void setUp(const FluidState& gas, double dt, PressureScratch& scratch) {
  const double h = gas.pressure.cellSize;
  const Vec3i n = gas.pressure.size;
  parallelFor(0, n.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) {
          const bool solid = gas.solid.inside(i, j, k);
          scratch.r(i + 1, j + 1, k + 1) =
              solid ? 0 : h * (h * gas.divergence(i, j, k) - divergence(gas.velocity, i, j, k));
          scratch.x(i + 1, j + 1, k + 1) = solid ? 0 : dt * gas.pressure(i, j, k);
        }
  });
}

/// A pocket that no open face reaches can only be solved for a source whose sum is zero.
void removePocketSources(const FluidState& gas, const FluidSettings& settings, PressureScratch& scratch) {
  const Vec3i n = gas.pressure.size;
  std::vector<double> sum(gas.solid.pocketCount + 1), size(gas.solid.pocketCount + 1),
      absolute(gas.solid.pocketCount + 1);
  const auto forPockets = [&](const auto& visit) {
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i)
          if (const int pocket = gas.solid.pocket(i, j, k); pocket > 0) visit(pocket, scratch.r(i + 1, j + 1, k + 1));
  };
  forPockets([&](int pocket, double b) {
    sum[pocket] += b;
    absolute[pocket] += std::abs(b);
    size[pocket] += 1;
  });
  constexpr double rounding = 1e-5;  // of float velocities
  for (int pocket = 1; pocket <= gas.solid.pocketCount; ++pocket)
    if (!settings.removeMeanSource && std::abs(sum[pocket]) > rounding * absolute[pocket] && absolute[pocket] > 0)
      throw InputError(
          fmt::format("gas: a sealed space of {} cells receives {:.3g} m3/s of gas and has no way out: open a face of "
                      "gas.faces or an opening "
                      "in the solids, or set gas.remove_mean_source = true",
                      size[pocket], sum[pocket] * gas.pressure.cellSize));
  forPockets([&](int pocket, double& b) { b -= sum[pocket] / size[pocket]; });
}

/// u += grad x, per component; p = x / dt.
void subtractGradient(FluidState& gas, const PressureOperator& op, double dt, const Grid3<double>& x) {
  const double h = gas.pressure.cellSize;
  for (int axis = 0; axis < 3; ++axis) {
    Grid3<float>& speed = gas.velocity.component(axis);
    const Grid3<float>& share = op.share.component(axis);
    const std::int64_t back = x.stride(axis);
    parallelFor(0, speed.size.z, 2, [&](std::int64_t first, std::int64_t last) {
      for (int k = static_cast<int>(first); k < last; ++k)
        for (int j = 0; j < speed.size.y; ++j)
          for (int i = 0; i < speed.size.x; ++i) {
            const std::int64_t here = x.index(i + 1, j + 1, k + 1);
            const double step = share(i, j, k) * (x.values[here] - x.values[here - back]) / h;
            speed(i, j, k) = static_cast<float>(speed(i, j, k) - step);
          }
    });
  }
  const Vec3i n = gas.pressure.size;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) gas.pressure(i, j, k) = static_cast<float>(x(i + 1, j + 1, k + 1) / dt);
}
}  // namespace

PressureOperator makePressureOperator(const SolidStamp& solid, const Faces& faces) {
  PressureOperator op{solid.inside.size, solid.openShare};
  for (int face = 0; face < 6; ++face) {
    if (faces[face] != FaceKind::open) continue;
    const int axis = face / 2, b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
    Grid3<float>& share = op.share.component(axis);
    const int layer = face % 2 ? share.size[axis] - 1 : 0;
    for (int q = 0; q < share.size[c]; ++q)
      for (int p = 0; p < share.size[b]; ++p)
        share.values[layer * share.stride(axis) + p * share.stride(b) + q * share.stride(c)] *= 2;
  }
  return op;
}

PressureReport solveConjugateGradient(const PressureOperator& op, const ConjugateGradient& settings,
                                      PressureScratch& scratch) {
  auto& [x, r, d, q] = scratch;
  const double goal = settings.tolerance * settings.tolerance * squaredNorm(op.cells, r);
  if (goal == 0) {
    std::fill(x.values.begin(), x.values.end(), 0.0);
    return {};
  }
  applyOperator(op, x, q);
  double delta = addScaled(op.cells, r, -1, q);
  d = r;
  PressureReport report;
  while (delta > goal && report.iterations < settings.maxIterations) {
    const double alpha = delta / applyOperator(op, d, q);
    addScaled(op.cells, x, alpha, d);
    const double next = addScaled(op.cells, r, -alpha, q);
    turnDirection(op.cells, d, next / delta, r);
    delta = next;
    ++report.iterations;
  }
  report.residual = std::sqrt(delta / goal) * settings.tolerance;
  report.converged = delta <= goal;
  return report;
}

PressureReport project(FluidState& gas, const FluidSettings& settings, double dt, PressureScratch& scratch) {
  resize(scratch, gas);
  setUp(gas, dt, scratch);
  if (gas.solid.pocketCount > 0) removePocketSources(gas, settings, scratch);
  const PressureOperator op = makePressureOperator(gas.solid, settings.faces);
  const PressureReport report = std::visit(
      [&](const ConjugateGradient& cg) { return solveConjugateGradient(op, cg, scratch); }, settings.pressure);
  subtractGradient(gas, op, dt, scratch.x);
  return report;
}

double divergenceError(const FluidState& gas) {
  const Vec3i n = gas.pressure.size;
  const double h = gas.pressure.cellSize;
  const auto norm = [&](const auto& value) {
    return std::sqrt(parallelSum(n.z, 1, [&](std::int64_t k, std::int64_t) {
      double sum = 0;
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i)
          if (!gas.solid.inside(i, j, static_cast<int>(k))) {
            const double v = value(i, j, static_cast<int>(k));
            sum += v * v;
          }
      return sum;
    }));
  };
  const double error =
      norm([&](int i, int j, int k) { return divergence(gas.velocity, i, j, k) / h - gas.divergence(i, j, k); });
  const double source = norm([&](int i, int j, int k) { return gas.divergence(i, j, k); });
  return source > 0 ? error / source : error;
}

double createdVolume(const FluidState& gas, const FluidSettings& settings) {
  const auto& phi = gas.divergence.values;
  const auto& solid = gas.solid.inside.values;
  const double sum =
      parallelSum(static_cast<std::int64_t>(phi.size()), 4096, [&](std::int64_t first, std::int64_t last) {
        double part = 0;
        for (std::int64_t n = first; n < last; ++n) part += solid[n] ? 0 : phi[n];
        return part;
      });
  return sum * settings.cellSize * settings.cellSize * settings.cellSize;
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
