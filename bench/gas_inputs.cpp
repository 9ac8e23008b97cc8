#include "gas_inputs.h"

#include "base/random.h"
#include "fluid/solid_fractions.h"
#include "mesh/shapes.h"

namespace brisance::bench {

FluidSettings boxOf(int cells, FaceKind kind) {
  constexpr double boxSide = 1;  // [m]
  FluidSettings settings;
  settings.cells = {cells, cells, cells};
  settings.cellSize = boxSide / cells;
  settings.faces.fill(kind);
  return settings;
}

SolidStamp threeSolids(const FluidSettings& settings) {
  const auto at = [](const Vec3d& place, const TriangleMesh& mesh) {
    return MovingSolid{std::make_shared<const TriangleMesh>(mesh), {place, {}}, {}, {}};
  };
  const std::vector<MovingSolid> solids{at({.75, .4, .15}, boxMesh({.16, .2, .3}, false)),
                                        at({.25, .7, .45}, sphereMesh(.1, 32)),
                                        at({.3, .3, .25}, boxMesh({.002, .4, .5}, false))};
  return stampSolids(settings, solids);
}

CellField sourceField(const SolidStamp& solid) {
  const Vec3i n = solid.inside.size;
  const std::pair<Vec3d, std::array<double, 2>> clouds[] = {
      {{.5, .3, .5}, {.08, 1}}, {{.32, .42, .61}, {.05, -.6}}, {{.7, .55, .4}, {.06, .8}}, {{.45, .7, .35}, {.1, .5}}};
  const Random random(1, Stream::test);
  CellField b{CellLayout(n)};
  double sum = 0, gas = 0;
  const auto forGas = [&](const auto& visit) {
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i)
          if (!solid.inside(i, j, k)) visit(i, j, k);
  };
  forGas([&](int i, int j, int k) {
    const Vec3d p((i + .5) / n.x, (j + .5) / n.y, (k + .5) / n.z);
    double value = .1 * std::sin(17 * p.x + 3 * p.y) * std::cos(11 * p.y - 5 * p.z) * std::sin(13 * p.z + 2);
    for (const auto& [centre, cloud] : clouds) {
      const double distance = length(p - centre) / cloud[0];
      value += cloud[1] * std::exp(-distance * distance);
    }
    value += .05 * (random.uniform(static_cast<std::uint64_t>(b.layout.index(i, j, k))) - .5);
    b(i, j, k) = static_cast<float>(value);
    sum += value;
    ++gas;
  });
  forGas([&](int i, int j, int k) { b(i, j, k) -= static_cast<float>(sum / gas); });
  return b;
}

double trueResidual(const SolidStamp& solid, const Faces& faces, const CellField& b, const CellField& x) {
  const PressureOperator op = makePressureOperator(solid, faces);
  const Vec3i n = op.cells;
  const std::int64_t strides[3] = {1, x.layout.row, x.layout.plane};
  double wrong = 0, all = 0;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        if (solid.inside(i, j, k)) continue;
        const float* at = x.row(j, k) + i;
        const Vec3i place{i, j, k};
        // to the cell `step` further along an axis, or around a periodic box
        const auto flow = [&](float share, int axis, int step) {
          if (share == 0) return 0.0;
          const bool around = place[axis] + step < 0 || place[axis] + step >= n[axis];
          const bool periodic = around && faces[2 * axis] == FaceKind::periodic;
          return share * (double(*at) - at[strides[axis] * (periodic ? step - step * n[axis] : step)]);
        };
        const double image = flow(op.share.u(i, j, k), 0, -1) + flow(op.share.u(i + 1, j, k), 0, 1) +
                             flow(op.share.v(i, j, k), 1, -1) + flow(op.share.v(i, j + 1, k), 1, 1) +
                             flow(op.share.w(i, j, k), 2, -1) + flow(op.share.w(i, j, k + 1), 2, 1);
        const double source = b(i, j, k);
        wrong += (source - image) * (source - image);
        all += source * source;
      }
  return std::sqrt(wrong / all);
}

}  // namespace brisance::bench
