// The levels of the multigrid method: what their faces let through, and how values pass between them.
#include <algorithm>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/multigrid.h"

namespace brisance::detail {

namespace {
constexpr int shortestAxis = 2;  // cells, not halved any more

/// couplings of the finest level: 1 inside, 2 to the p = 0 of an open face of the box, times the open share.
MultigridLevel finestLevel(const SolidStamp& solid, const Faces& faces) {
  const CellLayout layout(solid.inside.size);
  MultigridLevel level;
  for (int axis = 0; axis < 3; ++axis) {
    level.open[axis] = 1;
    level.coupling[axis] = CellField(layout);
    const Grid3<float>& share = solid.openShare.component(axis);
    for (int k = 0; k < share.size.z; ++k)
      for (int j = 0; j < share.size.y; ++j)
        for (int i = 0; i < share.size.x; ++i) {
          const int place[3] = {i, j, k};
          const int side = place[axis] == 0 ? 0 : place[axis] == layout.cells[axis] ? 1 : -1;
          const bool outer = side >= 0 && faces[2 * axis + side] == FaceKind::open;
          level.coupling[axis](i, j, k) = (outer ? 2.0f : 1.0f) * share(i, j, k);
        }
  }
  return level;
}

AxisInterpolation interpolationAlong(int n, FaceKind lower, FaceKind upper) {
  AxisInterpolation axis;
  axis.ratio = n > shortestAxis ? 2 : 1;
  const int coarse = (n + axis.ratio - 1) / axis.ratio;
  for (int i = 0; i < n; ++i) {
    const int nearest = i / axis.ratio, other = nearest + (i % 2 ? 1 : -1);
    const bool inside = other >= 0 && other < coarse;
    // Beyond a wall the same value lies, beyond an open face, where p = 0, the opposite one.
    const bool opposite = !inside && (other < 0 ? lower : upper) == FaceKind::open;
    axis.other.push_back(inside ? other : nearest);
    axis.near.push_back(axis.ratio == 1 ? 1.0f : 0.75f);
    axis.far.push_back(axis.ratio == 1 ? 0.0f : opposite ? -0.25f : 0.25f);
  }
  return axis;
}

/// A coarse face takes what its fine faces let through, over as much greater a distance.
MultigridLevel coarserLevel(const MultigridLevel& fine) {
  const Vec3i n = fine.coupling[0].layout.cells;
  Vec3i cells;
  for (int axis = 0; axis < 3; ++axis)
    cells[axis] = (n[axis] + fine.coarser[axis].ratio - 1) / fine.coarser[axis].ratio;
  MultigridLevel level;
  const CellLayout layout(cells);
  for (int axis = 0; axis < 3; ++axis) {
    level.coupling[axis] = CellField(layout);
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const int ratio = fine.coarser[axis].ratio, rb = fine.coarser[b].ratio, rc = fine.coarser[c].ratio;
    level.open[axis] = fine.open[axis] * static_cast<float>(rb * rc) / static_cast<float>(ratio);
    Vec3i at;
    for (at[c] = 0; at[c] < cells[c]; ++at[c])
      for (at[b] = 0; at[b] < cells[b]; ++at[b])
        for (at[axis] = 0; at[axis] <= cells[axis]; ++at[axis]) {
          float sum = 0;
          Vec3i from;
          from[axis] = std::min(at[axis] * ratio, n[axis]);
          for (from[c] = at[c] * rc; from[c] < std::min((at[c] + 1) * rc, n[c]); ++from[c])
            for (from[b] = at[b] * rb; from[b] < std::min((at[b] + 1) * rb, n[b]); ++from[b])
              sum += fine.coupling[axis](from.x, from.y, from.z);
          level.coupling[axis](at.x, at.y, at.z) = sum / static_cast<float>(ratio);
        }
  }
  return level;
}

/// The diagonal, and which rows need no couplings from memory.
void finishLevel(MultigridLevel& level) {
  const CellLayout& layout = level.coupling[0].layout;
  const Vec3i n = layout.cells;
  for (CellField* field : {&level.inverseDiagonal, &level.x, &level.b, &level.residual}) *field = CellField(layout);
  level.plainRow.assign(static_cast<std::size_t>(n.y) * n.z, 0);
  parallelFor(0, n.z, 4, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < n.y; ++j) {
        bool plain = true;
        for (int i = 0; i < n.x; ++i) {
          const float pairs[3] = {level.coupling[0](i, j, k) + level.coupling[0](i + 1, j, k),
                                  level.coupling[1](i, j, k) + level.coupling[1](i, j + 1, k),
                                  level.coupling[2](i, j, k) + level.coupling[2](i, j, k + 1)};
          const float sum = (pairs[0] + pairs[1]) + pairs[2];
          level.inverseDiagonal(i, j, k) = sum > 0 ? 1 / sum : 0;
          const bool inner = i > 0 && i < n.x - 1;
          // (only the face of an open end reaches twice the coupling, and that belongs to an end cell or a whole row)
          for (int axis = 0; axis < 3; ++axis)
            if (inner && pairs[axis] != 2 * level.open[axis]) plain = false;
        }
        const bool border = j == 0 || k == 0 || j == n.y - 1 || k == n.z - 1;
        level.plainRow[j + static_cast<std::size_t>(n.y) * k] = plain && !border;
      }
  });
}
}  // namespace

std::vector<MultigridLevel> makeLevels(const SolidStamp& solid, const Faces& faces) {
  constexpr int coarsestAxis = 4;
  std::vector<MultigridLevel> levels{finestLevel(solid, faces)};
  for (;;) {
    MultigridLevel& level = levels.back();
    finishLevel(level);
    const Vec3i n = level.x.layout.cells;
    if (std::max({n.x, n.y, n.z}) <= coarsestAxis) return levels;
    for (int axis = 0; axis < 3; ++axis)
      level.coarser[axis] = interpolationAlong(n[axis], faces[lowerFaceOf(axis)], faces[upperFaceOf(axis)]);
    levels.push_back(coarserLevel(level));
  }
}

namespace {
/// A row of coarse or fine values between ghosts on both sides.
class GhostedRow {
 public:
  explicit GhostedRow(int n) : values_(n + 4, 0.0f) {}
  float* data() { return values_.data() + 2; }

 private:
  std::vector<float> values_;
};

/// How much fine sample i gives to (or takes of) coarse sample I.
float weight(const AxisInterpolation& axis, int i, int coarse) {
  return (i / axis.ratio == coarse ? axis.near[i] : 0) + (axis.other[i] == coarse ? axis.far[i] : 0);
}

struct FineSamples {
  int first, last;
};
FineSamples reaching(const AxisInterpolation& axis, int coarse) {
  const int n = static_cast<int>(axis.other.size()), margin = axis.ratio - 1;
  return {std::max(0, coarse * axis.ratio - margin), std::min(n, (coarse + 1) * axis.ratio + margin)};
}

void restrictRow(const AxisInterpolation& axis, float* fine, int n, int coarseCount, float* out) {
  if (axis.ratio == 1) {
    std::copy_n(fine, n, out);
    return;
  }
  fine[-1] = 4 * axis.far[0] * fine[0];  // far = +-1/4: the same or the opposite value beyond the end
  fine[n] = n % 2 ? 0 : 4 * axis.far[n - 1] * fine[n - 1];
  fine[n + 1] = 0;
  for (int i = 0; i < coarseCount; ++i)
    out[i] = 0.25f * (fine[2 * i - 1] + fine[2 * i + 2]) + 0.75f * (fine[2 * i] + fine[2 * i + 1]);
}

/// out += interpolated coarse row, but not in solids.
void prolongRow(const AxisInterpolation& axis, float* coarse, int coarseCount, const float* inverse, float* out,
                int n) {
  if (axis.ratio == 1) {
    for (int i = 0; i < n; ++i) out[i] += inverse[i] > 0 ? coarse[i] : 0;
    return;
  }
  coarse[-1] = 4 * axis.far[0] * coarse[0];
  coarse[coarseCount] = n % 2 ? 0 : 4 * axis.far[n - 1] * coarse[coarseCount - 1];
  for (int i = 0; i < n / 2; ++i) {
    const float lower = 0.75f * coarse[i] + 0.25f * coarse[i - 1], upper = 0.75f * coarse[i] + 0.25f * coarse[i + 1];
    out[2 * i] += inverse[2 * i] > 0 ? lower : 0;
    out[2 * i + 1] += inverse[2 * i + 1] > 0 ? upper : 0;
  }
  if (n % 2) out[n - 1] += inverse[n - 1] > 0 ? 0.75f * coarse[n / 2] + 0.25f * coarse[n / 2 - 1] : 0;
}
}  // namespace

std::int64_t grainOf(const CellLayout& layout) {
  constexpr std::int64_t cellsPerTask = 1 << 14;
  return std::max<std::int64_t>(1, cellsPerTask / (std::int64_t(layout.cells.x) * layout.cells.y));
}

void restrictResidual(const MultigridLevel& fine, MultigridLevel& coarse) {
  const Vec3i n = fine.x.layout.cells, m = coarse.x.layout.cells;
  const AxisInterpolation &alongX = fine.coarser[0], &alongY = fine.coarser[1], &alongZ = fine.coarser[2];
  parallelFor(0, m.z, grainOf(coarse.x.layout), [&](std::int64_t firstPlane, std::int64_t lastPlane) {
    GhostedRow sums(n.x);
    float* sum = sums.data();
    runWide([&] {
      for (int K = static_cast<int>(firstPlane); K < lastPlane; ++K)
        for (int J = 0; J < m.y; ++J) {
          std::fill_n(sum, n.x, 0.0f);
          const FineSamples planes = reaching(alongZ, K), rows = reaching(alongY, J);
          for (int k = planes.first; k < planes.last; ++k)
            for (int j = rows.first; j < rows.last; ++j) {
              const float share = weight(alongZ, k, K) * weight(alongY, j, J);
              const float* r = fine.residual.row(j, k);
              for (int i = 0; i < n.x; ++i) sum[i] += share * r[i];
            }
          restrictRow(alongX, sum, n.x, m.x, coarse.b.row(J, K));
        }
    });
  });
}

void addCorrection(const MultigridLevel& coarse, MultigridLevel& fine) {
  const Vec3i n = fine.x.layout.cells, m = coarse.x.layout.cells;
  const AxisInterpolation &alongX = fine.coarser[0], &alongY = fine.coarser[1], &alongZ = fine.coarser[2];
  parallelFor(0, n.z, grainOf(fine.x.layout), [&](std::int64_t firstPlane, std::int64_t lastPlane) {
    GhostedRow mixed(m.x);
    float* row = mixed.data();
    runWide([&] {
      for (int k = static_cast<int>(firstPlane); k < lastPlane; ++k)
        for (int j = 0; j < n.y; ++j) {
          const int K[2] = {k / alongZ.ratio, alongZ.other[k]}, J[2] = {j / alongY.ratio, alongY.other[j]};
          const float z[2] = {alongZ.near[k], alongZ.far[k]}, y[2] = {alongY.near[j], alongY.far[j]};
          const float *a = coarse.x.row(J[0], K[0]), *b = coarse.x.row(J[1], K[0]), *c = coarse.x.row(J[0], K[1]),
                      *d = coarse.x.row(J[1], K[1]);
          for (int i = 0; i < m.x; ++i)
            row[i] = z[0] * (y[0] * a[i] + y[1] * b[i]) + z[1] * (y[0] * c[i] + y[1] * d[i]);
          prolongRow(alongX, row, m.x, fine.inverseDiagonal.row(j, k), fine.x.row(j, k), n.x);
        }
    });
  });
}

}  // namespace brisance::detail
