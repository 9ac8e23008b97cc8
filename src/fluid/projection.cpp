#include "fluid/projection.h"

#include "base/parallel.h"
#include "base/vector_path.h"

namespace brisance {

namespace {
constexpr int lanes = CellLayout::lanes;

/// Speeds at the faces of a row of cells.
struct FaceRows {
  const float *u, *v, *vUpper, *w, *wUpper;
};

FaceRows facesOf(const MacVelocity& m, int j, int k) {
  return {&m.u(0, j, k), &m.v(0, j, k), &m.v(0, j + 1, k), &m.w(0, j, k), &m.w(0, j, k + 1)};
}

void sourceRow(const FaceRows& m, const float* phi, const std::uint8_t* inside, float h, int count, float* b) {
  for (int i = 0; i < count; ++i) {
    const float divergence = ((m.u[i + 1] - m.u[i]) + (m.vUpper[i] - m.v[i])) + (m.wUpper[i] - m.w[i]);
    b[i] = inside[i] ? 0.0f : h * (h * phi[i] - divergence);
  }
}

/// Sum of squares of a row, in 16 parts that do not depend on the vector width.
double squares(const float* values, int count) {
  float sums[lanes] = {};
  int i = 0;
  for (; i + lanes <= count; i += lanes)
    for (int l = 0; l < lanes; ++l) sums[l] += values[i + l] * values[i + l];
  double sum = 0;
  for (int l = 0; l < lanes; ++l) sum += sums[l];
  for (; i < count; ++i) sum += double(values[i]) * values[i];
  return sum;
}

/// Sum over the planes of planeSum(k), each compiled for wide vectors.
template <class PlaneSum>
double sumPlanes(int planes, const PlaneSum& planeSum) {
  return parallelSum(planes, 1, [&](std::int64_t k, std::int64_t) {
    double sum = 0;
    runWide([&] { sum = planeSum(static_cast<int>(k)); });
    return sum;
  });
}

/// Coupling of the box's faces: p = 0 half a cell beyond an open one.
float couplingOf(FaceKind kind) { return kind == FaceKind::open ? 2.0f : kind == FaceKind::periodic ? 1.0f : 0.0f; }

/// speed -= coupling share (upper - lower) / h along a row
void gradientRow(float coupling, const float* share, const float* lower, const float* upper, int count, float* speed) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) speed[i] -= (coupling * share[i]) * (upper[i] - lower[i]);
}

/// Takes the gradient from the faces of one component, plane by plane.
class GradientStep {
 public:
  GradientStep(FluidState& gas, const Faces& faces, const CellField& x)
      : gas_(gas), faces_(faces), x_(x), perCell_(static_cast<float>(1 / gas.pressure.cellSize)) {}

  void alongX(int k) const {
    const Vec3i n = gas_.pressure.size;
    for (int j = 0; j < n.y; ++j) {
      float* u = &gas_.velocity.u(0, j, k);
      const float* share = &gas_.solid.openShare.u(0, j, k);
      const float* x = x_.row(j, k);
      const bool around = faces_[0] == FaceKind::periodic;
      const float before = around ? x[n.x - 1] : 0, after = around ? x[0] : 0;
      gradientRow(coupling(0), share, &before, x, 1, u);
      gradientRow(perCell_, share + 1, x, x + 1, n.x - 1, u + 1);
      gradientRow(coupling(1), share + n.x, x + n.x - 1, &after, 1, u + n.x);
    }
  }
  void alongY(int k) const {
    const Vec3i n = gas_.pressure.size;
    const bool around = faces_[2] == FaceKind::periodic;
    for (int j = 0; j <= n.y; ++j)
      gradientRow(j == 0     ? coupling(2)
                  : j == n.y ? coupling(3)
                             : perCell_,
                  &gas_.solid.openShare.v(0, j, k), x_.row(j == 0 && around ? n.y - 1 : j - 1, k),
                  x_.row(j == n.y && around ? 0 : j, k), n.x, &gas_.velocity.v(0, j, k));
  }
  void alongZ(int k) const {
    const Vec3i n = gas_.pressure.size;
    const bool around = faces_[4] == FaceKind::periodic;
    for (int j = 0; j < n.y; ++j)
      gradientRow(k == 0     ? coupling(4)
                  : k == n.z ? coupling(5)
                             : perCell_,
                  &gas_.solid.openShare.w(0, j, k), x_.row(j, k == 0 && around ? n.z - 1 : k - 1),
                  x_.row(j, k == n.z && around ? 0 : k), n.x, &gas_.velocity.w(0, j, k));
  }

 private:
  float coupling(int face) const { return perCell_ * couplingOf(faces_[face]); }
  FluidState& gas_;
  const Faces& faces_;
  const CellField& x_;
  float perCell_;
};

void pressurePlane(FluidState& gas, const CellField& x, float perTime, bool first, int k) {
  const Vec3i n = gas.pressure.size;
  for (int j = 0; j < n.y; ++j) {
    float* p = &gas.pressure(0, j, k);
    const float* from = x.row(j, k);
    const std::uint8_t* inside = &gas.solid.inside(0, j, k);
    for (int i = 0; i < n.x; ++i) p[i] = inside[i] ? 0.0f : (first ? 0.0f : p[i]) + from[i] * perTime;
  }
}
}  // namespace

SourceNorms computeSource(const FluidState& gas, CellField& b) {
  const Vec3i n = gas.pressure.size;
  const float h = static_cast<float>(gas.pressure.cellSize);
  double speeds = 0;
  std::vector<double> planeSpeeds(n.z);
  const double source = sumPlanes(n.z, [&](int k) {
    double sum = 0, squaredSpeed = 0;
    for (int j = 0; j < n.y; ++j) {
      const FaceRows m = facesOf(gas.velocity, j, k);
      float* row = b.row(j, k);
      sourceRow(m, &gas.divergence(0, j, k), &gas.solid.inside(0, j, k), h, n.x, row);
      sum += squares(row, n.x);
      squaredSpeed += (squares(m.u, n.x) + squares(m.v, n.x)) + squares(m.w, n.x);
    }
    planeSpeeds[k] = squaredSpeed;
    return sum;
  });
  for (const double plane : planeSpeeds) speeds += plane;
  // Each speed u is off by up to u / 2^24 and counts in two cells.
  constexpr double unit = 1.0 / (1 << 24);
  return {std::sqrt(source), h * unit * std::sqrt(2 * speeds)};
}

double fieldNorm(const CellField& field) {
  const Vec3i n = field.layout.cells;
  return std::sqrt(sumPlanes(n.z, [&](int k) {
    double sum = 0;
    for (int j = 0; j < n.y; ++j) sum += squares(field.row(j, k), n.x);
    return sum;
  }));
}

void subtractGradient(FluidState& gas, const Faces& faces, double dt, const CellField& x, bool first) {
  const int planes = gas.pressure.size.z;
  const GradientStep step(gas, faces, x);
  const float perTime = static_cast<float>(1 / dt);
  parallelFor(0, planes, 1, [&](std::int64_t begin, std::int64_t end) {
    for (int k = static_cast<int>(begin); k < end; ++k)
      runWide([&] {
        step.alongX(k);
        step.alongY(k);
        step.alongZ(k);
        if (k + 1 == planes) step.alongZ(planes);
        pressurePlane(gas, x, perTime, first, k);
      });
  });
}

PocketSources detail::judgePockets(const std::vector<PocketSum>& regions, const SealedRegions& sealed, double cellSize,
                                   bool refuse) {
  constexpr double rounding = 1e-5;  // of float velocities
  PocketSources sources;
  for (std::size_t n = 0; n < regions.size(); ++n) {
    if (!sealed[n]) continue;
    const PocketSum& pocket = regions[n];
    ++sources.count;
    if (std::abs(pocket.sum) <= rounding * pocket.absolute) continue;
    const double source = pocket.sum * cellSize;
    if (refuse)
      throw InputError(
          fmt::format("gas: a sealed space of {} cells receives {:.3g} m3/s of gas and has no way out: open a face of "
                      "gas.faces or an opening "
                      "in the solids, or set gas.remove_mean_source = true",
                      pocket.cells, source));
    sources.removed += std::abs(source);
  }
  return sources;
}

}  // namespace brisance
