#include "fluid/conjugate_gradient.h"

#include <cmath>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/projection.h"

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
void resize(ConjugateGradientScratch& scratch, const FluidState& gas) {
  const Vec3i n = gas.pressure.size;
  const Vec3i padded{n.x + 2, n.y + 2, n.z + 2};
  if (scratch.x.size == padded) return;
  for (Grid3<double>* vector : {&scratch.x, &scratch.r, &scratch.d, &scratch.q})
    *vector =
        Grid3<double>(padded, gas.pressure.origin - Vec3d(1, 1, 1) * gas.pressure.cellSize, gas.pressure.cellSize, 0.0);
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

void startConjugateGradient(const FluidState& gas, double dt, ConjugateGradientScratch& scratch) {
  resize(scratch, gas);
  const double h = gas.pressure.cellSize;
  const Vec3i n = gas.pressure.size;
  parallelFor(0, n.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) {
          const bool solid = gas.solid.inside(i, j, k);
          scratch.r(i + 1, j + 1, k + 1) =
              solid ? 0 : h * (h * gas.divergence(i, j, k) - velocityDivergence(gas.velocity, i, j, k));
          scratch.x(i + 1, j + 1, k + 1) = solid ? 0 : dt * gas.pressure(i, j, k);
        }
  });
}

PressureReport solveConjugateGradient(const PressureOperator& op, const ConjugateGradient& settings,
                                      ConjugateGradientScratch& scratch) {
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

void applySolution(FluidState& gas, const PressureOperator& op, double dt, const ConjugateGradientScratch& scratch) {
  const Grid3<double>& x = scratch.x;
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

}  // namespace brisance
