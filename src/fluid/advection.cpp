#include "fluid/advection.h"

#include "base/parallel.h"
#include "base/vector_path.h"

namespace brisance {

namespace {
/// One row of samples of a padded component: the sample itself and its strides.
struct Row {
  const float* at;
  std::int64_t dy, dz;
};

Row rowOf(const PaddedGrid& grid, int j, int k) {
  return {grid.row(j, k), grid.values.stride(1), grid.values.stride(2)};
}

/// The same row seen along another set of axes: `step[a]` is the distance to the next sample along axis a.
struct Steps {
  const float* at;
  std::int64_t step[3];
};
Steps stepsOf(const Row& row) { return {row.at, {1, row.dy, row.dz}}; }

struct RowTask {
  int axis;
  float dtOverH, upwind, viscous;  // viscous = nu dt / h^2
};

/// Legend: U the component along `axis` whose row is updated, W the component that carries it along another axis.
/// The control volume of a face reaches from centre to centre of its two cells; its side faces carry the mean of W
/// there.
void advectRow(const RowTask& task, const Steps& U, const Steps (&W)[3], float* out, const float* open, int count) {
  for (int i = 0; i < count; ++i) {
    const float u = U.at[i];
    float flux = 0, divergence = 0, laplacian = 0;
    for (int b = 0; b < 3; ++b) {
      const float lower = U.at[i - U.step[b]], upper = U.at[i + U.step[b]];
      float carryLower, carryUpper;
      if (b == task.axis) {
        carryLower = 0.5f * (lower + u);
        carryUpper = 0.5f * (u + upper);
      } else {
        const Steps& w = W[b];
        const std::int64_t before = -w.step[task.axis];
        carryLower = 0.5f * (w.at[i + before] + w.at[i]);
        carryUpper = 0.5f * (w.at[i + before + w.step[b]] + w.at[i + w.step[b]]);
      }
      flux += donorFlux(carryUpper, u, upper, task.upwind) - donorFlux(carryLower, lower, u, task.upwind);
      divergence += carryUpper - carryLower;
      laplacian += (upper - u) - (u - lower);
    }
    const float moved = u - task.dtOverH * (flux - u * divergence) + task.viscous * laplacian;
    out[i] = open[i] > 0 ? moved : u;
  }
}

double donorWeight(const FluidSettings& settings) { return std::get<DonorCell>(settings.advection).upwindWeight; }

void advectComponent(int axis, const FluidState& gas, const FluidSettings& settings, double dt,
                     AdvectionScratch& scratch) {
  const PaddedVelocity& padded = scratch.velocity;
  Grid3<float>& out = scratch.newVelocity.component(axis);
  const Grid3<float>& open = gas.solid.openShare.component(axis);
  const double h = settings.cellSize;
  const RowTask task{axis, static_cast<float>(dt / h), static_cast<float>(donorWeight(settings)),
                     static_cast<float>(settings.viscosity * dt / (h * h))};
  parallelFor(0, out.size.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < out.size.y; ++j) {
        const Steps U = stepsOf(rowOf(padded.component[axis], j, k));
        const Steps W[3] = {stepsOf(rowOf(padded.component[0], j, k)), stepsOf(rowOf(padded.component[1], j, k)),
                            stepsOf(rowOf(padded.component[2], j, k))};
        const std::int64_t row = out.index(0, j, k);
        runWide([&] { advectRow(task, U, W, out.values.data() + row, open.values.data() + row, out.size.x); });
      }
  });
}

/// Legend: s the scalar, u v w the face speeds of the row.
struct ScalarRow {
  const float *u, *v, *vUpper, *w, *wUpper;
  Steps s;
  const std::uint8_t* solid;
};

void advectScalarRow(const ScalarRow& row, float dtOverH, float upwind, float* out, int count) {
  const Steps& s = row.s;
  for (int i = 0; i < count; ++i) {
    const float here = s.at[i];
    const float uLower = row.u[i], uUpper = row.u[i + 1];
    const float flux = (donorFlux(uUpper, here, s.at[i + 1], upwind) - donorFlux(uLower, s.at[i - 1], here, upwind)) +
                       (donorFlux(row.vUpper[i], here, s.at[i + s.step[1]], upwind) -
                        donorFlux(row.v[i], s.at[i - s.step[1]], here, upwind)) +
                       (donorFlux(row.wUpper[i], here, s.at[i + s.step[2]], upwind) -
                        donorFlux(row.w[i], s.at[i - s.step[2]], here, upwind));
    const float divergence = (uUpper - uLower) + (row.vUpper[i] - row.v[i]) + (row.wUpper[i] - row.w[i]);
    out[i] = row.solid[i] ? here : here - dtOverH * (flux - here * divergence);
  }
}

ScalarRow scalarRow(const FluidState& gas, const PaddedGrid& padded, int j, int k) {
  const auto at = [](const Grid3<float>& g, int jj, int kk) { return g.values.data() + g.index(0, jj, kk); };
  const MacVelocity& m = gas.velocity;
  return {at(m.u, j, k),
          at(m.v, j, k),
          at(m.v, j + 1, k),
          at(m.w, j, k),
          at(m.w, j, k + 1),
          stepsOf(rowOf(padded, j, k)),
          gas.solid.inside.values.data() + gas.solid.inside.index(0, j, k)};
}

/// What created gas brings: sum of (s - ambient) div u, times h^2 for the caller's h.
double createdContent(const Grid3<float>& scalar, const FluidState& gas, float ambient) {
  return parallelSum(scalar.size.z, 1, [&](std::int64_t first, std::int64_t last) {
    double sum = 0;
    const MacVelocity& m = gas.velocity;
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < scalar.size.y; ++j)
        for (int i = 0; i < scalar.size.x; ++i) {
          if (gas.solid.inside(i, j, k)) continue;
          const double divergence =
              (m.u(i + 1, j, k) - m.u(i, j, k)) + (m.v(i, j + 1, k) - m.v(i, j, k)) + (m.w(i, j, k + 1) - m.w(i, j, k));
          sum += (scalar(i, j, k) - ambient) * divergence;
        }
    return sum;
  });
}

/// What leaves through the box's faces: sum of the outward flux of (s - ambient), times h^2 for the caller's h.
double outwardFlux(const PaddedGrid& padded, const MacVelocity& velocity, float ambient, float upwind) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Grid3<float>& normal = velocity.component(axis);
    const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
    const std::int64_t step = padded.values.stride(axis);
    for (int side = 0; side < 2; ++side) {
      const int layer = side ? normal.size[axis] - 1 : 0;
      for (int q = 0; q < normal.size[c]; ++q)
        for (int p = 0; p < normal.size[b]; ++p) {
          const float speed = normal.values[layer * normal.stride(axis) + p * normal.stride(b) + q * normal.stride(c)];
          const float* upper = padded.values.values.data() + (layer + 1) * step + (p + 1) * padded.values.stride(b) +
                               (q + 1) * padded.values.stride(c);
          const double flux = donorFlux(speed, upper[-step] - ambient, upper[0] - ambient, upwind);
          sum += side ? flux : -flux;
        }
    }
  }
  return sum;
}
}  // namespace

void advectVelocity(FluidState& gas, const FluidSettings& settings, double dt, AdvectionScratch& scratch) {
  scratch.velocity.fill(gas.velocity, settings.faces, settings.wind);
  if (scratch.newVelocity.u.count() != gas.velocity.u.count()) scratch.newVelocity = gas.velocity;
  for (int axis = 0; axis < 3; ++axis) advectComponent(axis, gas, settings, dt, scratch);
  std::swap(gas.velocity, scratch.newVelocity);
}

Balance advectScalar(Grid3<float>& scalar, const FluidState& gas, const FluidSettings& settings, float ambient,
                     double dt, AdvectionScratch& scratch) {
  padScalar(scratch.scalar, scalar, gas.velocity, settings.faces, ambient);
  scratch.newScalar = scalar;
  const float upwind = static_cast<float>(donorWeight(settings)), dtOverH = static_cast<float>(dt / settings.cellSize);
  parallelFor(0, scalar.size.z, 2, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < scalar.size.y; ++j) {
        const ScalarRow row = scalarRow(gas, scratch.scalar, j, k);
        float* out = scratch.newScalar.values.data() + scalar.index(0, j, k);
        runWide([&] { advectScalarRow(row, dtOverH, upwind, out, scalar.size.x); });
      }
  });
  const double area = settings.cellSize * settings.cellSize;
  Balance balance;
  balance.in = dt * area * createdContent(scalar, gas, ambient);
  balance.out = dt * area * outwardFlux(scratch.scalar, gas.velocity, ambient, upwind);
  std::swap(scalar, scratch.newScalar);
  return balance;
}

}  // namespace brisance
