#include "fluid/projection.h"

#include "base/parallel.h"
#include "base/row_lanes.h"
#include "base/row_sum.h"
#include "base/vector_path.h"
#include "fluid/solid_rows.h"

namespace brisance {

namespace {
/// Speeds at the faces of a row of cells.
struct FaceRows {
  const float *u, *v, *vUpper, *w, *wUpper;
};

FaceRows facesOf(const MacVelocity& m, int j, int k) {
  return {&m.u(0, j, k), &m.v(0, j, k), &m.v(0, j + 1, k), &m.w(0, j, k), &m.w(0, j, k + 1)};
}

/// Writes h (h phi - div u h) and adds up the squares of it and of the speeds.
template <int floats>
void sourceRow(const FaceRows& faces, const float* phi, const std::uint8_t* solids, float h, int count, float* b,
               std::array<Lanes, 2>& squares) {
  const FaceRows m = faces;  // which no store changes
  overLanes<floats>(count, squares, [=]<int n>(std::int64_t i, auto& sums) {
    using V = NamedVectors<n>;
    using Vector = typename V::Type;
    const Vector u = V::at(m.u + i), uUpper = V::at(m.u + i + 1), v = V::at(m.v + i), w = V::at(m.w + i);
    const Vector vUpper = V::at(m.vUpper + i), wUpper = V::at(m.wUpper + i), rate = V::at(phi + i), none{};
    Vector source = h * (h * rate - (((uUpper - u) + (vUpper - v)) + (wUpper - w)));
    if (solids) {
      typename V::Bits solid;
      V::whereSet(solids + i, solid);
      source = solid ? none : source;
    }
    V::at(b + i) = source;
    sums[0] += source * source;
    sums[1] += (u * u + v * v) + w * w;
  });
}

inline double squared(float value) { return double(value) * value; }
}  // namespace

VelocitySource::VelocitySource(const FluidState& gas) : gas_(gas), planes_(gas.pressure.size.z) {}

void VelocitySource::plane(int k, float* b, std::int64_t stride) {
  const Vec3i n = gas_.pressure.size;
  const float h = static_cast<float>(gas_.pressure.cellSize);
  LaneTotal source, speeds;
  for (int j = 0; j < n.y; ++j) {
    const FaceRows m = facesOf(gas_.velocity, j, k);
    const float* phi = &gas_.divergence(0, j, k);
    const std::uint8_t* solids = solidsOfRow(gas_.solid, j, k);
    std::array<Lanes, 2> squares{};
    runWithVectors([&]<int floats>() { sourceRow<floats>(m, phi, solids, h, n.x, b + j * stride, squares); });
    source.add(squares[0]);
    speeds.add(squares[1]);
  }
  planes_[k] = {source.take(), speeds.take()};
}

SourceNorms VelocitySource::norms() const {
  double source = 0, speeds = 0;
  for (const Sums& plane : planes_) {
    source += plane.source;
    speeds += plane.speeds;
  }
  // Each speed u is off by up to u / 2^24 and counts in two cells.
  constexpr double unit = 1.0 / (1 << 24);
  return {std::sqrt(source), gas_.pressure.cellSize * unit * std::sqrt(2 * speeds)};
}

SourceNorms computeSource(const FluidState& gas, CellField& b) {
  VelocitySource source(gas);
  parallelFor(0, gas.pressure.size.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k) source.plane(k, b.row(0, k), b.layout.row);
  });
  return source.norms();
}

double fieldNorm(const CellField& field) {
  const Vec3i n = field.layout.cells;
  return std::sqrt(parallelSum(n.z, 1, [&](std::int64_t k, std::int64_t) {
    RowSum sum(n.x);
    for (int j = 0; j < n.y; ++j) {
      const float* row = field.row(j, static_cast<int>(k));
      runWide([&] { sum.add([=](std::int64_t i) { return squared(row[i]); }); });
    }
    return sum.take();
  }));
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
