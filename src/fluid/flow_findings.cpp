#include "fluid/flow_findings.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/solid_rows.h"

namespace brisance {

namespace {
/// The larger magnitude.
template <int floats>
inline void larger(const typename NamedVectors<floats>::Type& a, const typename NamedVectors<floats>::Type& b,
                   typename NamedVectors<floats>::Type& result) {
  typename NamedVectors<floats>::Type one, other;
  NamedVectors<floats>::magnitude(a, one);
  NamedVectors<floats>::magnitude(b, other);
  result = one > other ? one : other;
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

FlowLook::FlowLook(const FluidState& gas) : gas_(gas), perLength_(static_cast<float>(1 / gas.divergence.cellSize)) {}

template <int floats, bool solids, bool sources>
void FlowLook::addSums(const Row& at) {
  const Row row = at;  // which no store changes
  const float perLength = perLength_;
  enum { fastest, wrong, source, created };
  std::array<Lanes, sources ? 4 : 2> lanes{fastest_};
  overLanes<floats>(gas_.divergence.size.x, lanes, [=]<int n>(std::int64_t i, auto& sums) {
    using V = NamedVectors<n>;
    using Vector = typename V::Type;
    const Vector u = V::at(row.u + i), uUpper = V::at(row.u + i + 1), v = V::at(row.v + i),
                 vUpper = V::at(row.vUpper + i), w = V::at(row.w + i), wUpper = V::at(row.wUpper + i), none{};
    Vector lack = (((uUpper - u) + (vUpper - v)) + (wUpper - w)) * perLength, speed, speedV, speedW;
    [[maybe_unused]] typename V::Bits solid;
    if constexpr (solids) V::whereSet(row.solids + i, solid);
    if constexpr (sources) {
      const Vector phi = V::at(row.phi + i), phiSquared = phi * phi;
      lack -= phi;
      if constexpr (solids) {
        sums[source] += solid ? none : phiSquared;
        sums[created] += solid ? none : phi;
      } else {
        sums[source] += phiSquared;
        sums[created] += phi;
      }
    }
    const Vector lackSquared = lack * lack;
    if constexpr (solids)
      sums[wrong] += solid ? none : lackSquared;
    else
      sums[wrong] += lackSquared;
    larger<n>(u, uUpper, speed);
    larger<n>(v, vUpper, speedV);
    larger<n>(w, wUpper, speedW);
    speed = (speed + speedV) + speedW;
    sums[fastest] = speed > sums[fastest] ? speed : sums[fastest];
  });
  fastest_ = lanes[fastest];
  wrong_.add(lanes[wrong]);
  if constexpr (sources) {
    source_.add(lanes[source]);
    created_.add(lanes[created]);
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
  runWithVectors([&]<int floats>() {
    const bool sources = anySource(row.phi, gas_.divergence.size.x);
    if (row.solids)
      sources ? addSums<floats, true, true>(row) : addSums<floats, true, false>(row);
    else
      sources ? addSums<floats, false, true>(row) : addSums<floats, false, false>(row);
  });
  outward_ += outwardAt(row, j, k);
}

FlowFindings FlowLook::take() {
  return {wrong_.take(), source_.take(), created_.take(), std::exchange(outward_, 0.0), takeLargest(fastest_)};
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
