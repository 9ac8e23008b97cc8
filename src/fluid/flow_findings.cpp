#include "fluid/flow_findings.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/solid_rows.h"

namespace brisance {

namespace {
inline float larger(float a, float b) {
  a = std::abs(a), b = std::abs(b);
  return a > b ? a : b;
}
/// Whether any is not zero.
bool anySource(const float* rates, int count) {
  constexpr std::uint32_t allButSign = 0x7fffffff;
  std::uint32_t found = 0;
  for (int i = 0; i < count; ++i) found |= std::bit_cast<std::uint32_t>(rates[i]) & allButSign;
  return found != 0;
}
double sumOfRow(const float* values, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += values[i];
  return sum;
}
}  // namespace

void FlowFindings::operator+=(const FlowFindings& o) {
  wrong += o.wrong;
  source += o.source;
  created += o.created;
  outward += o.outward;
  fastest = std::max(fastest, o.fastest);
}

FlowLook::FlowLook(const FluidState& gas)
    : gas_(gas),
      perLength_(1 / gas.divergence.cellSize),
      wrong_(gas.divergence.size.x),
      source_(gas.divergence.size.x),
      created_(gas.divergence.size.x),
      fastest_(gas.divergence.size.x) {}

template <bool solids, bool sources>
void FlowLook::addSums(const Row& at) {
  const Row row = at;  // which no store changes
  const double perLength = perLength_;
  double *wrong = wrong_.parts(), *source = source_.parts(), *created = created_.parts();
  float* fastest = fastest_.parts();
  const int count = gas_.divergence.size.x;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const bool solid = solids && row.solids[i];
    const double phi = sources ? row.phi[i] : 0.0f, along = double(row.u[i + 1]) - row.u[i],
                 up = double(row.vUpper[i]) - row.v[i], across = double(row.wUpper[i]) - row.w[i],
                 lack = ((along + up) + across) * perLength - phi;
    const double lackSquared = lack * lack, phiSquared = phi * phi;
    wrong[i] += solid ? 0 : lackSquared;
    if constexpr (sources) {
      source[i] += solid ? 0 : phiSquared;
      created[i] += solid ? 0 : phi;
    }
    const float speed =
        larger(row.u[i], row.u[i + 1]) + larger(row.v[i], row.vUpper[i]) + larger(row.w[i], row.wUpper[i]);
    fastest[i] = speed > fastest[i] ? speed : fastest[i];
  }
}

double FlowLook::outwardAt(const Row& row, int j, int k) const {
  const Vec3i n = gas_.divergence.size;
  double sum = double(row.u[n.x]) - row.u[0];
  if (j == 0) sum -= sumOfRow(row.v, n.x);
  if (j + 1 == n.y) sum += sumOfRow(row.vUpper, n.x);
  if (k == 0) sum -= sumOfRow(row.w, n.x);
  if (k + 1 == n.z) sum += sumOfRow(row.wUpper, n.x);
  return sum;
}

void FlowLook::row(int j, int k) {
  const MacVelocity& m = gas_.velocity;
  const Row row{&m.u(0, j, k),
                &m.v(0, j, k),
                &m.v(0, j + 1, k),
                &m.w(0, j, k),
                &m.w(0, j, k + 1),
                &gas_.divergence(0, j, k),
                solidsOfRow(gas_.solid, j, k)};
  runWide([&] {
    const bool sources = anySource(row.phi, gas_.divergence.size.x);
    if (row.solids)
      sources ? addSums<true, true>(row) : addSums<true, false>(row);
    else
      sources ? addSums<false, true>(row) : addSums<false, false>(row);
  });
  outward_ += outwardAt(row, j, k);
}

FlowFindings FlowLook::take() {
  return {wrong_.take(), source_.take(), created_.take(), std::exchange(outward_, 0.0), fastest_.take()};
}

FlowFindings sumOf(const std::vector<FlowFindings>& planes) {
  FlowFindings all;
  for (const FlowFindings& plane : planes) all += plane;
  return all;
}

FlowFindings lookAtFlow(const FluidState& gas) {
  const Vec3i n = gas.divergence.size;
  std::vector<FlowFindings> planes(n.z);
  parallelFor(0, n.z, 2, [&](std::int64_t first, std::int64_t last) {
    FlowLook look(gas);
    for (int k = static_cast<int>(first); k < last; ++k) {
      for (int j = 0; j < n.y; ++j) look.row(j, k);
      planes[k] = look.take();
    }
  });
  return sumOf(planes);
}

}  // namespace brisance
