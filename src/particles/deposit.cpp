#include "particles/deposit.h"

#include <cmath>
#include <cstring>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "grid/separable_blur.h"

namespace brisance {

namespace {

/// (1 - t^2/R^2)^3 at whole t, R in cells.
std::vector<double> kernelShape(double radius) {
  std::vector<double> shape;
  for (int t = 0; t == 0 || t < radius; ++t) {
    const double inside = 1 - t * t / (radius * radius);
    shape.push_back(inside * inside * inside);
  }
  return shape;
}

double varianceOf(const std::vector<double>& shape) {
  double sum = shape[0], squares = 0;
  for (std::size_t t = 1; t < shape.size(); ++t) {
    sum += 2 * shape[t];
    squares += 2 * shape[t] * static_cast<double>(t * t);
  }
  return squares / sum;
}

/// The kernel (1 - x^2/R^2)^3 has the variance R^2/9; sharing a particle linearly between cells adds 1/6 of a cell
/// squared on average, f (1 - f) at a distance f. The filter makes up the rest.
SymmetricFilter depositFilter(double radiusInCells) {
  const double wanted = radiusInCells * radiusInCells / 9 - 1.0 / 6;
  if (wanted <= 0) return {};
  double lower = 1, upper = radiusInCells + 2;  // a radius of one cell spreads nothing
  constexpr int halvings = 50;
  for (int n = 0; n < halvings; ++n) {
    const double middle = (lower + upper) / 2;
    (varianceOf(kernelShape(middle)) < wanted ? lower : upper) = middle;
  }
  return SymmetricFilter(kernelShape(upper));
}

bool hasSolids(const Grid3<std::uint8_t>& solid) {
  return std::memchr(solid.values.data(), 1, solid.values.size()) != nullptr;  // many bytes at once, std::find one
}

/// One over the share of each cell's kernel that falls on gas, 0 where none does.
void normalizeByGas(const Grid3<std::uint8_t>& solid, const SymmetricFilter& filter, Grid3<float>& perSource) {
  perSource = Grid3<float>(solid.size, solid.origin, solid.cellSize);
  BlurTask task{.size = solid.size, .channels = 1, .filter = filter, .fill = {}, .finish = {}};
  task.fill = [&](const CellSpan& rows, int k, LayerRows& near, LayerRows&) {
    for (int j = std::max(0, rows.first); j < std::min(solid.size.y, rows.end); ++j) {
      for (int i = 0; i < solid.size.x; ++i) near[j][i] = solid(i, j, k) ? 0.f : 1.f;
      near.hasFilled(j, {0, solid.size.x});
    }
  };
  task.finish = [&](int j, int k, const CellSpan& piece, const CellSpan&, const float* share) {
    for (int i = piece.first; i < piece.end; ++i) perSource(i, j, k) = share[i] > 0 ? 1 / share[i] : 0;
  };
  blurSeparably(task);
}

/// The deposit as points in cells; runs of them at once. Where a solid stands among the eight cells around a particle,
/// all of it belongs to the nearest of them that is not solid.
class DepositPoints {
 public:
  DepositPoints(const Grid3<std::uint8_t>& solid, bool anySolids) : solid_(solid), anySolids_(anySolids) {}

  /// And their rows of cells; -1 for what burns nothing.
  void make(const Vec3d* places, const double* burnt, int count, std::int32_t* rows, SplatPoint<1>* points) const {
    ShareRun share;
    setShares(places, count, share);
    const BandedRows numbers(solid_.size.y, solid_.size.z);
    runWide([&] {
      for (int n = 0; n < count; ++n) rows[n] = burnt[n] > 0 ? share.rowOf(n, numbers) : -1;
    });
    for (int n = 0; n < count; ++n) points[n] = {share[n], {static_cast<float>(burnt[n])}};
  }

 private:
  void setShares(const Vec3d* places, int count, ShareRun& share) const {
    const double perCell = 1 / solid_.cellSize;
    runWide([&] {
      for (int axis = 0; axis < 3; ++axis)
        share.set(axis, count, solid_.size[axis],
                  [place = &places->x + axis, origin = solid_.origin[axis], perCell](int n) {
                    return (place[3 * n] - origin) * perCell;
                  });
    });
    for (int n = 0; anySolids_ && n < count; ++n) share.set(n, outsideSolids(share[n]));
  }
  CellShares outsideSolids(const CellShares& share) const {
    CellShares nearest = share;
    float largest = -1;
    bool touches = false;
    for (int corner = 0; corner < 8; ++corner) {
      CellShares cell;
      float weight = 1;
      for (int axis = 0; axis < 3; ++axis) {
        const bool upper = corner >> axis & 1;
        cell[axis] = {std::min(share[axis].lower + upper, solid_.size[axis] - 1), 0};
        weight *= upper ? share[axis].fraction : 1 - share[axis].fraction;
      }
      const bool blocked = solid_(cell[0].lower, cell[1].lower, cell[2].lower);
      touches = touches || blocked;
      if (blocked || weight <= largest) continue;
      largest = weight;
      nearest = cell;
    }
    return touches ? nearest : share;
  }

  const Grid3<std::uint8_t>& solid_;
  bool anySolids_;
};

void renewNormalizer(const Grid3<std::uint8_t>& solid, const SymmetricFilter& filter, double kernelCells,
                     DepositScratch& scratch) {
  if (scratch.solid == solid && scratch.kernelCells == kernelCells) return;
  normalizeByGas(solid, filter, scratch.perSource);
  scratch.solid = solid;
  scratch.kernelCells = kernelCells;
}

void sortBurnt(const ParticleSet& particles, const std::vector<double>& burnt, const Grid3<std::uint8_t>& solid,
               bool anySolids, Binned<SplatPoint<1>>& sorted) {
  const DepositPoints points(solid, anySolids);
  const Vec3d* places = particles.position.data();
  sortIntoBins(
      std::ssize(burnt), BandedRows(solid.size.y, solid.size.z).count(),
      [&](std::int64_t first, std::int64_t end, std::int32_t* rows, SplatPoint<1>* made) {
        points.make(places + first, burnt.data() + first, static_cast<int>(end - first), rows, made);
      },
      sorted);
}

}  // namespace

void depositBurnt(const ParticleSet& particles, const std::vector<double>& burnt, const BurnSettings& settings,
                  double dt, const Grid3<std::uint8_t>& solid, Grid3<float>& rate, DepositScratch& scratch) {
  const double kernelCells = settings.depositRadius / solid.cellSize;
  BlurTask task{.size = solid.size, .channels = 1, .filter = depositFilter(kernelCells), .fill = {}, .finish = {}};
  const bool solids = hasSolids(solid);
  if (solids) renewNormalizer(solid, task.filter, kernelCells, scratch);
  sortBurnt(particles, burnt, solid, solids, scratch.points);
  std::array<std::vector<float>, 3> gain;  // what solids do not keep the box's faces do not either
  for (int axis = 0; axis < 3; ++axis)
    gain[axis] = solids ? std::vector<float>(solid.size[axis], 1.f) : task.filter.gainInside(solid.size[axis]);
  const LayerSplat<1> splat(scratch.points, std::move(gain));
  task.fill = [&](const CellSpan& rows, int k, LayerRows& near, LayerRows& far) {
    splat(rows, k, near, far);
    for (int j = std::max(0, rows.first); solids && j < std::min(solid.size.y, rows.end); ++j)
      for (int i = near.filled(j).first; i < std::min(solid.size.x, near.filled(j).end); ++i)
        near[j][i] *= scratch.perSource(i, j, k);
  };
  const float perVolume = static_cast<float>(1 / (dt * rate.cellSize * rate.cellSize * rate.cellSize));
  task.finish = [&](int j, int k, const CellSpan& piece, const CellSpan&, const float* mass) {
    float* row = &rate(0, j, k);
    const std::uint8_t* blocked = &solid(0, j, k);
    runWide([=] {
#pragma GCC ivdep
      for (int i = piece.first; i < piece.end; ++i) row[i] = blocked[i] ? 0.f : mass[i] * perVolume;
    });
  };
  blurSeparably(task);
}

double largestDeposit(std::size_t burning, const BurnSettings& settings, double cellSize) {
  const double middle = depositFilter(settings.depositRadius / cellSize)(0) / cellSize;
  return static_cast<double>(burning) * settings.burnRate * middle * middle * middle;
}

}  // namespace brisance
