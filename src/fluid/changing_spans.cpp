#include "fluid/changing_spans.h"

#include <bit>

#include "base/parallel.h"
#include "base/row_lines.h"
#include "base/vector_path.h"

namespace brisance {

namespace {
/// The span from the first to the last cell of which mark(i) is not 0. Looks from both ends, at many cells at once.
template <class Mark>
RowSpan spanOfMarked(int count, const Mark& mark) {
  constexpr int many = 4 * lineFloats;
  const auto any = [&](int first, int end) {
    std::uint32_t found = 0;
    for (int i = first; i < end; ++i) found |= mark(i);
    return found != 0;
  };
  const auto anyOfMany = [&](int first) {
    std::uint32_t found = 0;
    for (int i = 0; i < many; ++i) found |= mark(first + i);
    return found != 0;
  };
  int first = 0, end = count;
  while (first + many <= end && !anyOfMany(first)) first += many;
  while (first < end && !any(first, first + 1)) ++first;
  while (end - many >= first && !anyOfMany(end - many)) end -= many;
  while (end > first && !any(end - 1, end)) --end;
  return {first, end};
}

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }
}  // namespace

void ChangingSpans::find(const FluidState& gas, const FluidSettings& settings) {
  cells_ = gas.temperature.size;
  for (int axis = 0; axis < 3; ++axis) around_[axis] = isPeriodic(settings.faces, axis);
  differing_.resize(static_cast<std::size_t>(cells_.y) * cells_.z);
  fed_.resize(differing_.size());
  const std::uint32_t ambient = bits(static_cast<float>(settings.ambientTemperature));
  parallelFor(0, std::ssize(differing_), 64, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row)
      runWide([&] {
        const std::int64_t at = row * cells_.x;
        const float *T = &gas.temperature.values[at], *soot = &gas.soot.values[at], *flame = &gas.flame.values[at],
                    *heat = &gas.heatRate.values[at], *burn = &gas.burnRate.values[at];
        differing_[row] =
            spanOfMarked(cells_.x, [=](int i) { return (bits(T[i]) ^ ambient) | bits(soot[i]) | bits(flame[i]); });
        fed_[row] = spanOfMarked(cells_.x, [=](int i) { return (bits(heat[i]) | bits(burn[i])) << 1; });  // but signs
      });
  });
}

RowSpan ChangingSpans::at(int j, int k) const {
  RowSpan span = differing(j, k);
  if (!span.empty()) span = {span.first - 1, span.end + 1};
  span.join(fed_[std::int64_t{cells_.y} * k + j]);
  if (j > 0 || around_[1]) span.join(differing(j > 0 ? j - 1 : cells_.y - 1, k));
  if (j + 1 < cells_.y || around_[1]) span.join(differing(j + 1 < cells_.y ? j + 1 : 0, k));
  if (k > 0 || around_[2]) span.join(differing(j, k > 0 ? k - 1 : cells_.z - 1));
  if (k + 1 < cells_.z || around_[2]) span.join(differing(j, k + 1 < cells_.z ? k + 1 : 0));
  if (span.empty()) return {};
  return around_[0] ? RowSpan{0, cells_.x} : wholeLines(span);
}

RowSpan ChangingSpans::wholeLines(const RowSpan& span) const {
  const auto floor = [](int cells) { return std::max(cells, 0) / lineFloats * lineFloats; };
  RowSpan lines{floor(span.first), std::min(cells_.x, floor(span.end + lineFloats - 1))};
  // Where the last line is not full, vectors go over it together with cells before it.
  if (const int lastVector = cells_.x - lineFloats; cells_.x % lineFloats && lines.end > lastVector)
    lines = {std::min(lines.first, floor(lastVector)), cells_.x};
  return lines;
}

}  // namespace brisance
