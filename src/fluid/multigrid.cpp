#include "fluid/multigrid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "base/vector_path.h"

namespace brisance {

namespace {
constexpr int lanes = CellLayout::lanes;

/// What a loop along a row reads. Legend: x the unknowns, u v w the couplings.
struct Row {
  const float *x, *u, *v, *vUpper, *w, *wUpper;
  std::int64_t dy, dz;
};

Row rowOf(const MultigridLevel& level, const CellField& x, int j, int k) {
  return {x.row(j, k),
          level.coupling[0].row(j, k),
          level.coupling[1].row(j, k),
          level.coupling[1].row(j + 1, k),
          level.coupling[2].row(j, k),
          level.coupling[2].row(j, k + 1),
          x.layout.row,
          x.layout.plane};
}

/// sum of coupling x over the neighbours of cell i
inline float coupled(Row r, int i) {
  const float* x = r.x + i;
  return ((r.u[i] * x[-1] + r.u[i + 1] * x[1]) + (r.v[i] * x[-r.dy] + r.vUpper[i] * x[r.dy])) +
         (r.w[i] * x[-r.dz] + r.wUpper[i] * x[r.dz]);
}
/// A x at cell i
inline float applied(Row r, int i) {
  const float* x = r.x + i;
  const float c = x[0];
  return ((r.u[i] * (c - x[-1]) + r.u[i + 1] * (c - x[1])) + (r.v[i] * (c - x[-r.dy]) + r.vUpper[i] * (c - x[r.dy]))) +
         (r.w[i] * (c - x[-r.dz]) + r.wUpper[i] * (c - x[r.dz]));
}
/// The same where all faces are open.
inline float coupledOpen(Row r, Couplings open, int i) {
  const float* x = r.x + i;
  return (open.x * (x[-1] + x[1]) + open.y * (x[-r.dy] + x[r.dy])) + open.z * (x[-r.dz] + x[r.dz]);
}
inline float appliedOpen(Row r, Couplings open, int i) {
  const float* x = r.x + i;
  const float c = x[0];
  return (open.x * ((c - x[-1]) + (c - x[1])) + open.y * ((c - x[-r.dy]) + (c - x[r.dy]))) +
         open.z * ((c - x[-r.dz]) + (c - x[r.dz]));
}

bool isPlain(const MultigridLevel& level, int j, int k) {
  return level.plainRow[j + static_cast<std::size_t>(level.x.layout.cells.y) * k];
}

/// Calls general(begin, end) or open(begin, end) on the parts of a row.
template <class General, class Open>
void splitRow(const MultigridLevel& level, int j, int k, const General& general, const Open& open) {
  const int n = level.x.layout.cells.x;
  if (n < 3 || !isPlain(level, j, k)) return general(0, n);
  general(0, 1);
  open(1, n - 1);
  general(n - 1, n);
}

/// next for cells of one parity, old for the others. By bits: a condition would keep the loop from being vectorised,
/// since the compiler may not compute a number in vain that could trap.
inline float everyOther(float next, float old, int i, int parity) {
  const std::uint32_t taken = static_cast<std::uint32_t>((i + parity) & 1) - 1u;
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(next) & taken) |
                              (std::bit_cast<std::uint32_t>(old) & ~taken));
}

/// What relaxation reads besides: cells of `parity` are to change.
struct RelaxTask {
  const float *b, *inverse;
  int parity;
};

/// Writes value(i) over every other x[i]. In two loops, for in one the compiler would see x[i] depend on x[i - 1],
/// though only where it is not changed.
template <class Value>
void replaceEveryOther(int begin, int end, int parity, float* x, const Value& value) {
  constexpr int block = 256;
  float next[block];
  for (int start = begin; start < end; start += block) {
    const int count = std::min(block, end - start);
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) next[i] = value(start + i);
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) x[start + i] = everyOther(next[i], x[start + i], start + i, parity);
  }
}

void relaxSpan(Row r, RelaxTask task, int begin, int end, float* x) {
  replaceEveryOther(begin, end, task.parity, x, [=](int i) { return (task.b[i] + coupled(r, i)) * task.inverse[i]; });
}

void relaxOpenSpan(Row r, Couplings open, RelaxTask task, int begin, int end, float* x) {
  const float inverse = 1 / ((2 * open.x + 2 * open.y) + 2 * open.z);
  replaceEveryOther(begin, end, task.parity, x, [=](int i) { return (task.b[i] + coupledOpen(r, open, i)) * inverse; });
}

/// Gauss-Seidel on every other cell of a row. A cell of the other colour is computed too, and kept as it was.
void relaxRow(MultigridLevel& level, int j, int k, int colour) {
  const Row r = rowOf(level, level.x, j, k);
  float* x = level.x.row(j, k);
  const RelaxTask task{level.b.row(j, k), level.inverseDiagonal.row(j, k), (j + k + colour) & 1};
  splitRow(
      level, j, k, [&](int begin, int end) { relaxSpan(r, task, begin, end, x); },
      [&](int begin, int end) { relaxOpenSpan(r, level.open, task, begin, end, x); });
}

/// out = A x
void applySpan(Row r, int begin, int end, float* out) {
#pragma GCC ivdep
  for (int i = begin; i < end; ++i) out[i] = applied(r, i);
}

void applyOpenSpan(Row r, Couplings open, int begin, int end, float* out) {
#pragma GCC ivdep
  for (int i = begin; i < end; ++i) out[i] = appliedOpen(r, open, i);
}

void applyRow(const MultigridLevel& level, const CellField& x, int j, int k, float* out) {
  const Row r = rowOf(level, x, j, k);
  splitRow(
      level, j, k, [&](int begin, int end) { applySpan(r, begin, end, out); },
      [&](int begin, int end) { applyOpenSpan(r, level.open, begin, end, out); });
}

void startRow(MultigridLevel& level, int j, int k, int colour) {
  float* x = level.x.row(j, k);
  const float *b = level.b.row(j, k), *inverse = level.inverseDiagonal.row(j, k);
  const int parity = (j + k + colour) & 1, n = level.x.layout.cells.x;
  for (int i = 0; i < n; ++i) x[i] = (i & 1) == parity ? b[i] * inverse[i] : 0.0f;
}

/// Calls work(k) for every other plane; such planes do not see one another.
template <class Work>
void forAlternatePlanes(const MultigridLevel& level, int parity, const Work& work) {
  const CellLayout& layout = level.x.layout;
  parallelFor(0, (layout.cells.z - parity + 1) / 2, detail::grainOf(layout),
              [&](std::int64_t first, std::int64_t last) {
                for (auto n = first; n < last; ++n) runWide([&] { work(static_cast<int>(2 * n) + parity); });
              });
}

/// Gauss-Seidel in every other plane: first one colour of its cells, then, while they are in the cache, the other.
void relaxPlanes(MultigridLevel& level, int parity, int firstColour) {
  const int rows = level.x.layout.cells.y;
  forAlternatePlanes(level, parity, [&](int k) {
    for (int j = 0; j < rows; ++j) relaxRow(level, j, k, firstColour);
    for (int j = 0; j < rows; ++j) relaxRow(level, j, k, 1 - firstColour);
  });
}

/// Sum over rows of rowSum(sums, j, k), which adds to 16 partial sums.
template <class RowSum>
double sumRows(const CellLayout& layout, const RowSum& rowSum) {
  return parallelSum(layout.cells.z, 1, [&](std::int64_t k, std::int64_t) {
    double sum = 0;
    runWide([&] {
      for (int j = 0; j < layout.cells.y; ++j) {
        float sums[lanes] = {};
        rowSum(sums, j, static_cast<int>(k));
        float part = 0;
        for (int l = 0; l < lanes; ++l) part += sums[l];
        sum += part;
      }
    });
    return sum;
  });
}

/// sums += a b over a row; cells beyond the box hold zero.
void addProducts(float (&sums)[lanes], const float* a, const float* b, int count) {
  for (int i = 0; i < count; i += lanes)
    for (int l = 0; l < lanes; ++l) sums[l] += a[i + l] * b[i + l];
}

double dot(const CellField& a, const CellField& b) {
  const CellLayout& layout = a.layout;
  return sumRows(layout, [&](float(&sums)[lanes], int j, int k) {
    addProducts(sums, a.row(j, k), b.row(j, k), layout.roundedRow());
  });
}

/// p = z + beta p
void turnDirection(const CellField& z, float beta, CellField& p) {
  const CellLayout& layout = z.layout;
  parallelFor(0, layout.cells.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      runWide([&] {
        for (int j = 0; j < layout.cells.y; ++j) {
          const float* from = z.row(j, k);
          float* to = p.row(j, k);
          for (int i = 0; i < layout.roundedRow(); ++i) to[i] = from[i] + beta * to[i];
        }
      });
  });
}

/// x += alpha p; r -= alpha q; returns |r|^2
double advance(float alpha, const CellField& p, const CellField& q, CellField& x, CellField& r) {
  const CellLayout& layout = p.layout;
  return sumRows(layout, [&](float(&sums)[lanes], int j, int k) {
    const float *pRow = p.row(j, k), *qRow = q.row(j, k);
    float *xRow = x.row(j, k), *rRow = r.row(j, k);
#pragma GCC ivdep
    for (int i = 0; i < layout.roundedRow(); ++i) {
      xRow[i] += alpha * pRow[i];
      rRow[i] -= alpha * qRow[i];
    }
    addProducts(sums, rRow, rRow, layout.roundedRow());
  });
}
}  // namespace

namespace detail {
void relaxForward(MultigridLevel& level) {
  relaxPlanes(level, 0, 0);
  relaxPlanes(level, 1, 0);
}

void relaxBackward(MultigridLevel& level) {
  relaxPlanes(level, 1, 1);
  relaxPlanes(level, 0, 1);
}

void relaxFromZero(MultigridLevel& level) {
  const CellLayout& layout = level.x.layout;
  forAlternatePlanes(level, 1, [&](int k) {
    for (int j = 0; j < layout.cells.y; ++j) std::fill_n(level.x.row(j, k), layout.cells.x, 0.0f);
  });
  forAlternatePlanes(level, 0, [&](int k) {
    for (int j = 0; j < layout.cells.y; ++j) startRow(level, j, k, 0);
    for (int j = 0; j < layout.cells.y; ++j) relaxRow(level, j, k, 1);
  });
  relaxPlanes(level, 1, 0);
}

void computeResidual(MultigridLevel& level) {
  const CellLayout& layout = level.x.layout;
  parallelFor(0, layout.cells.z, grainOf(layout), [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      runWide([&] {
        for (int j = 0; j < layout.cells.y; ++j) {
          const float* b = level.b.row(j, k);
          float* out = level.residual.row(j, k);
          applyRow(level, level.x, j, k, out);
          for (int i = 0; i < layout.cells.x; ++i) out[i] = b[i] - out[i];
        }
      });
  });
}

double applyLevel(const MultigridLevel& level, const CellField& direction, CellField& product) {
  const CellLayout& layout = direction.layout;
  return sumRows(layout, [&](float(&sums)[lanes], int j, int k) {
    float* out = product.row(j, k);
    applyRow(level, direction, j, k, out);
    addProducts(sums, direction.row(j, k), out, layout.roundedRow());
  });
}
}  // namespace detail

Multigrid::Multigrid(const SolidStamp& solid, const Faces& faces, BodyPush push)
    : levels_(detail::makeLevels(solid, faces)), direction_(layout()), product_(layout()), push_(std::move(push)) {}

/// product = A direction; returns direction . product
double Multigrid::applyOperator() {
  double pq = detail::applyLevel(levels_.front(), direction_, product_);
  if (push_.empty()) return pq;
  const auto changes = push_.response([&](const BodyContact& c) { return direction_.values[c.cell]; });
  push_.addOutflow(changes, [&](const BodyContact& c, double value) {
    product_.values[c.cell] += static_cast<float>(value);
    pq += direction_.values[c.cell] * value;
  });
  return pq;
}

/// One V-cycle from zero, symmetric: what is relaxed before the coarse correction is relaxed after it in reverse order.
void Multigrid::cycle(std::size_t number) {
  MultigridLevel& level = levels_[number];
  detail::relaxFromZero(level);
  if (number + 1 == levels_.size()) {
    constexpr int coarsestSweeps = 12;
    for (int sweep = 1; sweep < coarsestSweeps; ++sweep) detail::relaxForward(level);
    for (int sweep = 0; sweep < coarsestSweeps; ++sweep) detail::relaxBackward(level);
    return;
  }
  MultigridLevel& coarse = levels_[number + 1];
  detail::computeResidual(level);
  detail::restrictResidual(level, coarse);
  cycle(number + 1);
  detail::addCorrection(coarse, level);
  detail::relaxBackward(level);
}

PressureReport Multigrid::solve(CellField& field, double tolerance, int maxIterations) {
  CellField& residual = levels_.front().b;
  const CellField& preconditioned = levels_.front().x;
  std::swap(residual.values, field.values);
  std::fill(field.values.begin(), field.values.end(), 0.0f);
  std::fill(direction_.values.begin(), direction_.values.end(), 0.0f);
  double squared = dot(residual, residual), lastRz = 0;
  const double goal = tolerance * tolerance * squared;
  PressureReport report;
  while (squared > goal && report.iterations < maxIterations) {
    cycle(0);
    const double rz = dot(residual, preconditioned);
    turnDirection(preconditioned, static_cast<float>(lastRz > 0 ? rz / lastRz : 0), direction_);
    lastRz = rz;
    const double pq = applyOperator();
    squared = advance(static_cast<float>(pq > 0 ? rz / pq : 0), direction_, product_, field, residual);
    ++report.iterations;
  }
  report.residual = goal > 0 ? tolerance * std::sqrt(squared / goal) : 0;
  report.converged = squared <= goal;
  return report;
}

}  // namespace brisance
