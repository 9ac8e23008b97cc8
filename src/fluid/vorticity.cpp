#include "fluid/vorticity.h"

#include <cmath>

#include "base/aligned.h"
#include "base/parallel.h"
#include "base/vector_path.h"

namespace brisance {

namespace {
/// A plane (constant k) of vectors at cell centres, and of their lengths.
struct VectorPlane {
  AlignedVector<float> x, y, z, length;
  explicit VectorPlane(std::int64_t cells) : x(cells), y(cells), z(cells), length(cells) {}
};

/// The planes of some layers of cells, from the vorticity of old speeds to new speeds; what lies between stays in a
/// cache. Legend: omega the vorticity, force = N x omega.
class Confinement {
 public:
  Confinement(const FluidState& gas, const FluidSettings& settings, double dt, MacVelocity& out)
      : old_(gas.velocity),
        solid_(gas.solid),
        faces_(settings.faces),
        size_(gas.temperature.size),
        perDifference_(static_cast<float>(0.25 / settings.cellSize)),
        perForce_(static_cast<float>(0.5 * dt * settings.vorticityConfinement * settings.cellSize)),
        out_(out),
        omega_(3, VectorPlane(planeCells())),
        force_(2, VectorPlane(planeCells())),
        vPair_(size_.x + 2),
        wPair_(size_.x + 2) {}

  /// New speeds of the faces of cells first <= k < last, and of the box's uppermost face where `last` is the box's end.
  void run(int first, int last) {
    makeOmega(first - 2);
    makeOmega(first - 1);
    const int end = last == size_.z ? last + 1 : last;
    for (int k = first - 1; k < end; ++k) {
      makeOmega(k + 1);
      makeForce(k);
      if (k >= first) push(k);
    }
  }

 private:
  std::int64_t planeCells() const { return static_cast<std::int64_t>(size_.x) * size_.y; }
  bool periodic(int axis) const { return isPeriodic(faces_, axis); }
  /// The number of a cell along an axis: the nearest inside, or around a periodic box.
  int cell(int n, int axis) const {
    const int count = size_[axis];
    return periodic(axis) ? (n + count) % count : std::clamp(n, 0, count - 1);
  }
  /// Whether a cell has neighbours on both sides along an axis.
  bool between(int n, int axis) const { return periodic(axis) || (n > 0 && n + 1 < size_[axis]); }
  VectorPlane& omega(int k) { return omega_[(k + 3) % 3]; }
  VectorPlane& force(int k) { return force_[(k + 2) % 2]; }

  /// Sums of the two speeds of each cell, with those of the cells before and after at [-1] and [size].
  const float* pairs(const float* lower, const float* upper, AlignedVector<float>& room) const {
    float* pair = room.data() + 1;
    for (int i = 0; i < size_.x; ++i) pair[i] = lower[i] + upper[i];
    pair[-1] = pair[cell(-1, 0)];
    pair[size_.x] = pair[cell(size_.x, 0)];
    return pair;
  }

  void makeOmega(int k) {
    if (!periodic(2) && (k < 0 || k >= size_.z)) return;
    VectorPlane& plane = omega(k);
    for (int j = 0; j < size_.y; ++j) runWide([&] { omegaRow(j, cell(k, 2), plane); });
  }

  void omegaRow(int j, int k, VectorPlane& plane) {
    const MacVelocity& m = old_;
    const int jL = cell(j - 1, 1), jU = cell(j + 1, 1), kL = cell(k - 1, 2), kU = cell(k + 1, 2);
    const float* v = pairs(&m.v(0, j, k), &m.v(0, j + 1, k), vPair_);
    const float* w = pairs(&m.w(0, j, k), &m.w(0, j, k + 1), wPair_);
    const float *uSouth = &m.u(0, jL, k), *uNorth = &m.u(0, jU, k), *uDown = &m.u(0, j, kL), *uUp = &m.u(0, j, kU);
    const float *wSouth = &m.w(0, jL, k), *wSouthUp = &m.w(0, jL, k + 1);
    const float *wNorth = &m.w(0, jU, k), *wNorthUp = &m.w(0, jU, k + 1);
    const float *vDown = &m.v(0, j, kL), *vDownNorth = &m.v(0, j + 1, kL);
    const float *vUp = &m.v(0, j, kU), *vUpNorth = &m.v(0, j + 1, kU);
    const std::int64_t row = static_cast<std::int64_t>(j) * size_.x;
    float *x = &plane.x[row], *y = &plane.y[row], *z = &plane.z[row], *length = &plane.length[row];
#pragma GCC ivdep
    for (int i = 0; i < size_.x; ++i) {
      const float wy = (wNorth[i] + wNorthUp[i]) - (wSouth[i] + wSouthUp[i]);
      const float vz = (vUp[i] + vUpNorth[i]) - (vDown[i] + vDownNorth[i]);
      const float uz = (uUp[i] + uUp[i + 1]) - (uDown[i] + uDown[i + 1]), wx = w[i + 1] - w[i - 1];
      const float vx = v[i + 1] - v[i - 1], uy = (uNorth[i] + uNorth[i + 1]) - (uSouth[i] + uSouth[i + 1]);
      const float ox = (wy - vz) * perDifference_, oy = (uz - wx) * perDifference_, oz = (vx - uy) * perDifference_;
      x[i] = ox;
      y[i] = oy;
      z[i] = oz;
      length[i] = std::sqrt((ox * ox + oy * oy) + oz * oz);
    }
  }

  void makeForce(int k) {
    VectorPlane& plane = force(k);
    for (int j = 0; j < size_.y; ++j) {
      const std::int64_t row = static_cast<std::int64_t>(j) * size_.x;
      if (between(k, 2) && between(j, 1)) {
        runWide([&] { forceRow(j, k, plane); });
      } else {
        for (auto* component : {&plane.x, &plane.y, &plane.z}) std::fill_n(component->begin() + row, size_.x, 0.0f);
      }
    }
  }

  void forceRow(int j, int k, VectorPlane& plane) {
    const std::int64_t row = static_cast<std::int64_t>(j) * size_.x;
    const VectorPlane& here = omega(k);
    const float *x = &here.x[row], *y = &here.y[row], *z = &here.z[row], *size = &here.length[row];
    const float* south = &here.length[static_cast<std::int64_t>(cell(j - 1, 1)) * size_.x];
    const float* north = &here.length[static_cast<std::int64_t>(cell(j + 1, 1)) * size_.x];
    const float *down = &omega(k - 1).length[row], *up = &omega(k + 1).length[row];
    float *fx = &plane.x[row], *fy = &plane.y[row], *fz = &plane.z[row];
    const auto forceAt = [&](int i, int before, int after) {
      const float gx = size[after] - size[before], gy = north[i] - south[i], gz = up[i] - down[i];
      const float steepness = std::sqrt((gx * gx + gy * gy) + gz * gz);
      const float unit = 1 / (steepness > 0 ? steepness : 1);
      fx[i] = (gy * z[i] - gz * y[i]) * unit;
      fy[i] = (gz * x[i] - gx * z[i]) * unit;
      fz[i] = (gx * y[i] - gy * x[i]) * unit;
    };
#pragma GCC ivdep
    for (int i = 1; i + 1 < size_.x; ++i) forceAt(i, i - 1, i + 1);
    for (const int i : {0, size_.x - 1}) {
      if (between(i, 0))
        forceAt(i, cell(i - 1, 0), cell(i + 1, 0));
      else
        fx[i] = fy[i] = fz[i] = 0;
    }
  }

  /// out = old + perForce (lower + upper) at open faces
  void pushRow(int axis, int j, int k, int first, int count, const float* lower, const float* upper) {
    const Grid3<float>& speed = old_.component(axis);
    const float *from = &speed(first, j, k), *open = &solid_.openShare.component(axis)(first, j, k);
    float* to = &out_.component(axis)(first, j, k);
    const float perForce = perForce_;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const float before = from[i], after = before + perForce * (lower[i] + upper[i]);
      to[i] = open[i] > 0 ? after : before;
    }
  }

  void push(int k) {
    const VectorPlane &here = force(k), &below = force(k - 1);
    const auto rowOf = [&](const AlignedVector<float>& plane, int j) {
      return &plane[static_cast<std::int64_t>(cell(j, 1)) * size_.x];
    };
    const int n = size_.x;
    runWide([&] {
      for (int j = 0; j < size_.y; ++j) {
        pushRow(2, j, k, 0, n, rowOf(below.z, j), rowOf(here.z, j));
        if (k == size_.z) continue;
        const float* x = rowOf(here.x, j);
        pushRow(0, j, k, 1, n - 1, x, x + 1);
        pushRow(0, j, k, 0, 1, x + cell(-1, 0), x);
        pushRow(0, j, k, n, 1, x + n - 1, x + cell(n, 0));
        pushRow(1, j, k, 0, n, rowOf(here.y, j - 1), rowOf(here.y, j));
        if (j + 1 == size_.y) pushRow(1, j + 1, k, 0, n, rowOf(here.y, j), rowOf(here.y, j + 1));
      }
    });
  }

  const MacVelocity& old_;
  const SolidStamp& solid_;
  const Faces& faces_;
  Vec3i size_;
  float perDifference_, perForce_;
  MacVelocity& out_;
  std::vector<VectorPlane> omega_, force_;
  AlignedVector<float> vPair_, wPair_;
};
}  // namespace

void confineVorticity(FluidState& gas, const FluidSettings& settings, double dt, MacVelocity& scratch) {
  if (settings.vorticityConfinement == 0) return;
  for (int axis = 0; axis < 3; ++axis)
    if (!(scratch.component(axis).size == gas.velocity.component(axis).size))
      scratch.component(axis) = gas.velocity.component(axis);
  constexpr int planesPerTask = 16;  // three planes more are made than are used
  const int planes = gas.temperature.size.z, tasks = (planes + planesPerTask - 1) / planesPerTask;
  parallelFor(0, tasks, 1, [&](std::int64_t first, std::int64_t last) {
    Confinement confinement(gas, settings, dt, scratch);
    for (std::int64_t task = first; task < last; ++task)
      confinement.run(static_cast<int>(task) * planesPerTask,
                      std::min(planes, static_cast<int>(task + 1) * planesPerTask));
  });
  std::swap(gas.velocity, scratch);
}

}  // namespace brisance
