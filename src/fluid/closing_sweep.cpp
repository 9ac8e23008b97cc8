#include "fluid/closing_sweep.h"

#include "base/aligned.h"
#include "base/parallel.h"
#include "base/stream_copy.h"
#include "base/vector_path.h"
#include "fluid/solid_rows.h"

namespace brisance {

namespace {
constexpr int planesPerTask = 16;  // whose first plane is looked at again

/// Coupling of the box's faces: p = 0 half a cell beyond an open one.
float couplingOf(FaceKind kind) { return kind == FaceKind::open ? 2.0f : kind == FaceKind::periodic ? 1.0f : 0.0f; }

/// speed -= coupling share (upper - lower) / h along a row
void gradientRow(float coupling, const float* share, const float* lower, const float* upper, int count, float* speed) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) speed[i] -= (coupling * share[i]) * (upper[i] - lower[i]);
}

/// Takes the gradient from a row of faces.
class GradientStep {
 public:
  GradientStep(FluidState& gas, const Faces& faces, const CellField& x, float perTime, bool first)
      : gas_(gas),
        faces_(faces),
        x_(x),
        perCell_(static_cast<float>(1 / gas.pressure.cellSize)),
        perTime_(perTime),
        first_(first) {}

  void alongX(int j, int k) const {
    const int n = gas_.pressure.size.x;
    float* u = &gas_.velocity.u(0, j, k);
    const float *share = openRow(gas_.solid, 0, j, k), *x = x_.row(j, k);
    const bool around = faces_[0] == FaceKind::periodic;
    const float before = around ? x[n - 1] : 0, after = around ? x[0] : 0;
    gradientRow(coupling(0), share, &before, x, 1, u);
    gradientRow(perCell_, share + 1, x, x + 1, n - 1, u + 1);
    gradientRow(coupling(1), share + n, x + n - 1, &after, 1, u + n);
  }
  void alongY(int j, int k) const {
    const Vec3i n = gas_.pressure.size;
    const bool around = faces_[2] == FaceKind::periodic;
    gradientRow(couplingAt(j, n.y, 2), openRow(gas_.solid, 1, j, k), x_.row(j == 0 && around ? n.y - 1 : j - 1, k),
                x_.row(j == n.y && around ? 0 : j, k), n.x, &gas_.velocity.v(0, j, k));
  }
  void alongZ(int j, int k) const {
    const Vec3i n = gas_.pressure.size;
    const bool around = faces_[4] == FaceKind::periodic;
    gradientRow(couplingAt(k, n.z, 4), openRow(gas_.solid, 2, j, k), x_.row(j, k == 0 && around ? n.z - 1 : k - 1),
                x_.row(j, k == n.z && around ? 0 : k), n.x, &gas_.velocity.w(0, j, k));
  }
  /// `room` holds a row.
  void pressure(int j, int k, float* room) const {
    const std::uint8_t* solids = solidsOfRow(gas_.solid, j, k);
    const float *x = x_.row(j, k), perTime = perTime_;
    float* p = &gas_.pressure(0, j, k);
    const int n = gas_.pressure.size.x;
    if (first_ && !solids) {  // nobody reads it soon
      for (int i = 0; i < n; ++i) room[i] = x[i] * perTime;
      return streamCopy(p, room, n);
    }
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) p[i] = (first_ ? 0.0f : p[i]) + x[i] * perTime;
    for (int i = 0; solids && i < n; ++i) p[i] = solids[i] ? 0.0f : p[i];
  }

 private:
  float coupling(int face) const { return perCell_ * couplingOf(faces_[face]); }
  float couplingAt(int n, int last, int lowerFace) const {
    return n == 0 ? coupling(lowerFace) : n == last ? coupling(lowerFace + 1) : perCell_;
  }
  FluidState& gas_;
  const Faces& faces_;
  const CellField& x_;
  float perCell_, perTime_;
  bool first_;
};

/// Planes of cells with the faces above them; a row that has all its faces is looked at at once. The faces below the
/// first plane are another task's, which may not be there yet.
void closePlanes(const GradientStep& step, const Vec3i& n, int begin, int end, FlowLook& look, float* room,
                 FlowFindings* planes) {
  if (begin == 0)
    runWide([&] {
      for (int j = 0; j < n.y; ++j) step.alongZ(j, 0);
    });
  for (int k = begin; k < end; ++k) {
    runWide([&] { step.alongY(0, k); });
    for (int j = 0; j < n.y; ++j) {
      runWide([&] {
        step.alongX(j, k);
        step.alongY(j + 1, k);
        step.alongZ(j, k + 1);
        step.pressure(j, k, room);
      });
      if (k > begin || k == 0) look.row(j, k);
    }
    planes[k] = look.take();
  }
}
}  // namespace

FlowFindings closeStep(FluidState& gas, const Faces& faces, double dt, const CellField& x, bool first) {
  const Vec3i n = gas.pressure.size;
  const int tasks = (n.z + planesPerTask - 1) / planesPerTask;
  const GradientStep step(gas, faces, x, static_cast<float>(1 / dt), first);
  std::vector<FlowFindings> planes(n.z);
  parallelFor(0, tasks, 1, [&](std::int64_t begin, std::int64_t end) {
    FlowLook look(gas);
    AlignedVector<float> room(n.x);
    for (int task = static_cast<int>(begin); task < end; ++task)
      closePlanes(step, n, task * planesPerTask, std::min(n.z, (task + 1) * planesPerTask), look, room.data(),
                  planes.data());
    endStreaming();
  });
  parallelFor(1, tasks, 1, [&](std::int64_t begin, std::int64_t end) {
    FlowLook look(gas);
    for (int task = static_cast<int>(begin); task < end; ++task) {
      for (int j = 0; j < n.y; ++j) look.row(j, task * planesPerTask);
      planes[task * planesPerTask] = look.take();
    }
  });
  return sumOf(planes);
}

}  // namespace brisance
