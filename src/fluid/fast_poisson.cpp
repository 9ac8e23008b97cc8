#include "fluid/fast_poisson.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/projection.h"

namespace brisance {

namespace {
constexpr std::int64_t blockOfCells = 2048;

/// The surface of one plane, found by one thread.
struct PlaneSurface {
  std::vector<std::int64_t> cell, other;
  std::vector<std::int32_t> linkCount;
  std::vector<float> missing;
};

/// A face of a cell in the empty box.
struct BoxFace {
  float share;  ///< 1 to the next cell, 2 to the p = 0 of an open face, 0 at a wall
  Vec3i other;  ///< cell behind it; a ghost beyond an open face
};

BoxFace boxFace(const BoxPoisson& box, const Vec3i& cell, int axis, int side) {
  const int n = box.layout().cells[axis];
  Vec3i other = cell;
  other[axis] += side ? 1 : -1;
  if (other[axis] >= 0 && other[axis] < n) return {1, other};
  const FaceKind kind = box.faces()[2 * axis + side];
  if (kind == FaceKind::open) return {2, other};
  if (kind != FaceKind::periodic) return {0, other};
  other[axis] = side ? 0 : n - 1;
  return {1, other};
}

void addCell(const SolidStamp& solid, const BoxPoisson& box, const Vec3i& cell, PlaneSurface& out) {
  std::int32_t links = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const Grid3<float>& open = solid.openShare.component(axis);
      const float share = open.values[open.index(cell.x, cell.y, cell.z) + side * open.stride(axis)];
      if (share == 1) continue;
      const BoxFace face = boxFace(box, cell, axis, side);
      if (face.share == 0) continue;
      out.other.push_back(box.layout().index(face.other.x, face.other.y, face.other.z));
      out.missing.push_back(face.share * (1 - share));
      ++links;
    }
  if (links == 0) return;
  out.cell.push_back(box.layout().index(cell.x, cell.y, cell.z));
  out.linkCount.push_back(links);
}

/// Whether every face of the row's cells is open, but for the two at the ends of the box.
bool rowIsOpen(const SolidStamp& solid, int j, int k) {
  const MacVelocity& open = solid.openShare;
  const int n = solid.inside.size.x;
  int closed = 0;
  const auto look = [&](const float* share, int count) {
    for (int i = 0; i < count; ++i) closed |= share[i] != 1.0f;
  };
  runWide([&] {
    look(&open.u(0, j, k) + 1, n - 1);
    look(&open.v(0, j, k), n);
    look(&open.v(0, j + 1, k), n);
    look(&open.w(0, j, k), n);
    look(&open.w(0, j, k + 1), n);
  });
  return closed == 0;
}

PlaneSurface surfaceOfPlane(const SolidStamp& solid, const BoxPoisson& box, int k) {
  PlaneSurface out;
  const Vec3i n = box.layout().cells;
  for (int j = 0; j < n.y; ++j) {
    const int step = rowIsOpen(solid, j, k) ? std::max(1, n.x - 1) : 1;  // only the ends, or every cell
    for (int i = 0; i < n.x; i += step)
      if (!solid.inside(i, j, k)) addCell(solid, box, {i, j, k}, out);
  }
  return out;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Marks the plane and the 16 rows in which a place of the field lies; ghosts need no marks, they stay zero.
void mark(const BoxPoisson& box, std::int64_t place, SparseRegion& region) {
  const CellLayout& layout = box.layout();
  const std::int64_t inside = place - layout.first;
  if (inside < 0) return;
  const std::int64_t k = inside / layout.plane, j = inside % layout.plane / layout.row;
  if (k >= layout.cells.z || j >= layout.cells.y) return;
  region.planes[k] = 1;
  region.tiles[k * box.tilesPerPlane() + j / LineTransform::lanes] = 1;
}

/// Solutions of the empty box for sources on the surface.
class SurfacePreconditioner {
 public:
  SurfacePreconditioner(const BoxPoisson& box, const SolidFaces& surface, CellField& work)
      : box_(box), surface_(surface), work_(work) {}

  void operator()(const std::vector<double>& sources) {
    const CellLayout& layout = box_.layout();
    box_.solve(work_, surface_.region, [&](int k, float* plane) {
      const std::int64_t start = layout.index(0, 0, k);
      for (std::int32_t n = surface_.planeBegin[k]; n < surface_.planeBegin[k + 1]; ++n)
        plane[surface_.cell[n] - start] = static_cast<float>(sources[n]);
    });
  }

 private:
  const BoxPoisson& box_;
  const SolidFaces& surface_;
  CellField& work_;
};

/// sum over links of missing (x_cell - x_other): what the operator among solids lacks of the empty box's.
double missingFlux(const SolidFaces& surface, const CellField& x, std::int64_t n) {
  const double here = x.values[surface.cell[n]];
  double sum = 0;
  for (std::int32_t link = surface.firstLink[n]; link < surface.firstLink[n + 1]; ++link)
    sum += surface.missing[link] * (here - x.values[surface.other[link]]);
  return sum;
}

void copyField(const CellField& from, CellField& to) {
  constexpr std::int64_t grain = 1 << 16;
  parallelFor(0, from.layout.count, grain, [&](std::int64_t first, std::int64_t last) {
    std::copy(from.values.begin() + first, from.values.begin() + last, to.values.begin() + first);
  });
}

/// Sum of term(n) over the cells of the surface, the same for any number of threads.
template <class Term>
double surfaceSum(const SolidFaces& surface, const Term& term) {
  return parallelSum(static_cast<std::int64_t>(surface.cell.size()), blockOfCells,
                     [&](std::int64_t first, std::int64_t last) {
                       double sum = 0;
                       for (std::int64_t n = first; n < last; ++n) sum += term(n);
                       return sum;
                     });
}

/// Legend: r residual, z preconditioned residual, p direction = M^-1 s, q = A p, y the sources beside b whose empty-box
/// solution is x = M^-1 (b + y).
class SurfaceIteration {
 public:
  SurfaceIteration(const SolidFaces& surface, const CellField& work, SurfaceVectors& v)
      : surface_(surface), work_(work), v_(v) {}

  /// From work = M^-1 b: r = b - A x is what x's gradient carries through closed faces, less what bodies give way.
  /// Returns |r|^2.
  double start() {
    surfaceSum(surface_, [&](std::int64_t n) {
      v_.correction[n] = v_.direction[n] = v_.source[n] = v_.product[n] = 0;
      v_.residual[n] = missingFlux(surface_, work_, n);
      return 0;
    });
    addGivingWay(-1, v_.residual);
    return surfaceSum(surface_, [&](std::int64_t n) { return v_.residual[n] * v_.residual[n]; });
  }
  /// From work = M^-1 r: one step of conjugate gradients. Returns |r|^2.
  double step() {
    const double rz = surfaceSum(surface_, [&](std::int64_t n) {
      const double z = v_.preconditioned[n] = work_.values[surface_.cell[n]];
      v_.image[n] = v_.residual[n] - missingFlux(surface_, work_, n);  // A z
      return v_.residual[n] * z;
    });
    addGivingWay(1, v_.image);
    const double beta = lastRz_ > 0 ? rz / lastRz_ : 0;
    lastRz_ = rz;
    const double pq = surfaceSum(surface_, [&](std::int64_t n) {
      v_.direction[n] = v_.preconditioned[n] + beta * v_.direction[n];
      v_.source[n] = v_.residual[n] + beta * v_.source[n];
      v_.product[n] = v_.image[n] + beta * v_.product[n];
      return v_.direction[n] * v_.product[n];
    });
    const double alpha = pq > 0 ? rz / pq : 0;
    return surfaceSum(surface_, [&](std::int64_t n) {
      v_.correction[n] += alpha * v_.source[n];
      v_.residual[n] -= alpha * v_.product[n];
      return v_.residual[n] * v_.residual[n];
    });
  }

 private:
  /// out += sign times what the bodies that work pushes make of the operator
  void addGivingWay(double sign, std::vector<double>& out) {
    const BodyPush& push = surface_.push;
    if (push.empty()) return;
    const auto changes = push.response([&](const BodyContact& c) { return work_.values[c.cell]; });
    push.addOutflow(changes, [&](const BodyContact& c, double value) { out[c.number] += sign * value; });
  }

  const SolidFaces& surface_;
  const CellField& work_;
  SurfaceVectors& v_;
  double lastRz_ = 0;
};
}  // namespace

SolidFaces findSurface(const SolidStamp& solid, const BoxPoisson& box) {
  const Vec3i cells = box.layout().cells;
  std::vector<PlaneSurface> planes(cells.z);
  parallelFor(0, cells.z, 1, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k) planes[k] = surfaceOfPlane(solid, box, k);
  });
  SolidFaces surface;
  surface.region.planes.assign(cells.z, 0);
  surface.region.tiles.assign(static_cast<std::size_t>(cells.z) * box.tilesPerPlane(), 0);
  surface.firstLink.push_back(0);
  for (const PlaneSurface& plane : planes) {
    surface.planeBegin.push_back(static_cast<std::int32_t>(surface.cell.size()));
    append(surface.cell, plane.cell);
    append(surface.other, plane.other);
    append(surface.missing, plane.missing);
    for (const std::int32_t links : plane.linkCount) surface.firstLink.push_back(surface.firstLink.back() + links);
  }
  surface.planeBegin.push_back(static_cast<std::int32_t>(surface.cell.size()));
  for (const std::int64_t place : surface.cell) mark(box, place, surface.region);
  for (const std::int64_t place : surface.other) mark(box, place, surface.region);
  return surface;
}

void addPush(BodyPush push, SolidFaces& surface) {
  for (BodyContact& contact : push.contacts()) {
    const auto cell = std::lower_bound(surface.cell.begin(), surface.cell.end(), contact.cell);
    CHECK(cell != surface.cell.end() && *cell == contact.cell, "cell {} of {}", contact.cell, surface.cell.size());
    contact.number = static_cast<std::int32_t>(cell - surface.cell.begin());
  }
  surface.push = std::move(push);
}

void SurfaceVectors::resize(std::size_t count) {
  for (auto* vector : {&residual, &source, &direction, &product, &correction, &preconditioned, &image})
    vector->resize(count);
}

PressureReport solveFastPoisson(const BoxPoisson& box, const SolidFaces& surface, double tolerance, int maxIterations,
                                CellField& field, CellField& work, SurfaceVectors& vectors) {
  PressureReport report;
  if (surface.empty()) {
    box.solve(field);
    report.iterations = 1;
    return report;
  }
  const double norm = tolerance * fieldNorm(field), goal = norm * norm;
  vectors.resize(surface.cell.size());
  copyField(field, work);
  box.solve(work);
  report.iterations = 1;
  SurfaceIteration iteration(surface, work, vectors);
  SurfacePreconditioner precondition(box, surface, work);
  double squared = iteration.start();
  while (squared > goal && report.iterations < maxIterations) {
    precondition(vectors.residual);
    squared = iteration.step();
    ++report.iterations;
  }
  for (std::size_t n = 0; n < surface.cell.size(); ++n)
    field.values[surface.cell[n]] += static_cast<float>(vectors.correction[n]);
  box.solve(field);
  report.residual = goal > 0 ? tolerance * std::sqrt(squared / goal) : 0;
  report.converged = squared <= goal;
  return report;
}

}  // namespace brisance
