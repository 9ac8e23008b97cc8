#include "grid/splat_blur.h"

#include "base/aligned.h"
#include "base/check.h"
#include "base/vector_path.h"

namespace brisance {

namespace {

constexpr int vectorFloats = 16;              // the widest vectors hold as many
constexpr int blockCells = 2 * vectorFloats;  // cells whose sums stay in registers

constexpr int roundUp(int count, int unit) { return (count + unit - 1) / unit * unit; }

/// Empty cells before and after a row, so that the filter and whole blocks may run over its ends.
int padding(int radius) { return roundUp(radius + 1, vectorFloats); }
int paddedWidth(int cells, int radius) { return roundUp(cells, blockCells) + 2 * padding(radius) + blockCells; }

/// Named as vectors, since the compiler would otherwise run along the filter, one cell at a time. Not for `auto`, which
/// forgets that they need not be aligned.
typedef float FloatVector __attribute__((vector_size(vectorFloats * sizeof(float)), aligned(sizeof(float)), may_alias));

/// Filtered sums over rows[-radius] .. rows[radius] of `blockCells` cells from `cell` on.
inline void sumBlock(const float* const* rows, const SymmetricFilter& filter, int cell, float* sums) {
  const FloatVector* middle = reinterpret_cast<const FloatVector*>(rows[0] + cell);
  FloatVector first = middle[0] * filter(0), second = middle[1] * filter(0);
  for (int t = 1; t <= filter.radius(); ++t) {
    const FloatVector* below = reinterpret_cast<const FloatVector*>(rows[-t] + cell);
    const FloatVector* above = reinterpret_cast<const FloatVector*>(rows[t] + cell);
    first += (below[0] + above[0]) * filter(t);
    second += (below[1] + above[1]) * filter(t);
  }
  FloatVector* result = reinterpret_cast<FloatVector*>(sums);
  result[0] = first;
  result[1] = second;
}

/// The sums of a span of cells, from the start of a vector on; `sums` has room for whole blocks.
inline void sumSpan(const float* const* rows, const SymmetricFilter& filter, const CellSpan& span, float* sums) {
  for (int cell = span.first / vectorFloats * vectorFloats; cell < span.end; cell += blockCells)
    sumBlock(rows, filter, cell, sums + cell);
}

/// The last rows along an axis, x-blurred or not, as many as the filter reaches: of each its channels one after the
/// other, with padding around them.
class RowRing {
 public:
  RowRing(const BlurTask& task)
      : filter_(task.filter),
        channels_(task.channels),
        pad_(padding(task.filter.radius())),
        width_(paddedWidth(task.size.x, task.filter.radius())),
        slots_(2 * task.filter.radius() + 1),
        rows_(static_cast<std::size_t>(slots_) * channels_ * width_, 0.f),
        spans_(slots_),
        sums_(static_cast<std::size_t>(channels_) * width_, 0.f),
        window_(slots_) {}

  int pad() const { return pad_; }
  int width() const { return width_; }

  /// Makes row n, in the place of the oldest, one that is filled in `span` only; the caller writes that. n counts up
  /// from -radius.
  void begin(int n, const CellSpan& span) {
    CellSpan& old = spans_[slotOf(n)];
    if (span.empty() || old.first < span.first || old.end > span.end)
      for (int c = 0; c < channels_; ++c) std::fill(row(n, c) + old.first, row(n, c) + old.end, 0.f);
    old = span;
  }
  float* row(int n, int channel) { return slot(n) + channel * width_ + pad_; }

  /// The cells that the sums over the rows around n fill: those of all rows.
  CellSpan reached() const {
    CellSpan all;
    for (const CellSpan& span : spans_) all.include(span);
    return all;
  }
  void sumAround(int n, const CellSpan& span) {
    const int radius = filter_.radius();
    for (int t = -radius; t <= radius; ++t) window_[t + radius] = slot(n + t);
    for (int c = 0; c < channels_; ++c) {
      const int start = c * width_ + pad_;
      sumSpan(window_.data() + radius, filter_, {start + span.first, start + span.end}, sums_.data());
    }
  }
  const float* sums(int channel) const { return sums_.data() + channel * width_ + pad_; }

 private:
  int slotOf(int n) const { return (n + slots_) % slots_; }
  float* slot(int n) { return rows_.data() + static_cast<std::int64_t>(slotOf(n)) * channels_ * width_; }

  const SymmetricFilter& filter_;
  int channels_, pad_, width_, slots_;
  AlignedVector<float> rows_;
  std::vector<CellSpan> spans_;
  AlignedVector<float> sums_;
  std::vector<const float*> window_;
};

/// Makes a layer's rows, blurs them along x and y and puts them into the caller's memory.
class LayerBlur {
 public:
  LayerBlur(const BlurTask& task, std::vector<CellSpan>& spans)
      : task_(task),
        spans_(spans),
        ring_(task),
        made_(static_cast<std::size_t>(task.channels) * (task.size.x + 1), 0.f),
        lines_(static_cast<std::size_t>(task.channels) * ring_.width(), 0.f),
        window_(2 * task.filter.radius() + 1) {}

  void run(int k) {
    const int radius = task_.filter.radius();
    for (int j = -radius; j < radius; ++j) take(j, k);
    for (int j = 0; j < task_.size.y; ++j) {
      take(j + radius, k);
      const CellSpan reached = ring_.reached();
      spans_[j + static_cast<std::int64_t>(task_.size.y) * k] = reached;
      if (reached.empty()) continue;
      runWide([&] { ring_.sumAround(j, reached); });
      for (int c = 0; c < task_.channels; ++c)
        std::copy(ring_.sums(c) + reached.first, ring_.sums(c) + reached.end, task_.memory(c, j, k) + reached.first);
    }
  }

 private:
  void take(int j, int k) {
    const bool inside = j >= 0 && j < task_.size.y;
    const CellSpan made = inside ? task_.fill(j, k, made_.data()) : CellSpan{};
    if (made.empty()) return ring_.begin(j, {});
    const int radius = task_.filter.radius();
    const CellSpan reached{std::max(0, made.first - radius), std::min(task_.size.x, made.end + radius)};
    ring_.begin(j, reached);
    runWide([&] { blurAlongX(j, made, reached); });
  }

  /// From cells side by side to a line for each channel.
  template <int channels>
  void takeApart(const CellSpan& made) {
    for (int c = 0; c < channels; ++c) {
      float* line = lines_.data() + c * ring_.width() + ring_.pad();
      for (int i = made.first; i < made.end; ++i) line[i] = made_[channels * i + c];
    }
    std::fill(made_.begin() + channels * made.first, made_.begin() + channels * made.end, 0.f);
  }

  void blurAlongX(int j, const CellSpan& made, const CellSpan& reached) {
    const int radius = task_.filter.radius();
    task_.channels == 4 ? takeApart<4>(made) : takeApart<1>(made);
    for (int c = 0; c < task_.channels; ++c) {
      float* line = lines_.data() + c * ring_.width() + ring_.pad();
      for (int t = -radius; t <= radius; ++t) window_[t + radius] = line + t;
      sumSpan(window_.data() + radius, task_.filter, reached,
              ring_.row(j, c));  // what lies beyond the span is not used
      std::fill(line + made.first, line + made.end, 0.f);
    }
  }

  const BlurTask& task_;
  std::vector<CellSpan>& spans_;
  RowRing ring_;
  AlignedVector<float> made_, lines_;
  std::vector<const float*> window_;
};

/// Blurs the rows of one j along z and hands them out: those of the ring are copies, since the place of the finished
/// ones is the caller's to use.
class ColumnBlur {
 public:
  ColumnBlur(const BlurTask& task, const std::vector<CellSpan>& spans)
      : task_(task), spans_(spans), ring_(task), blurred_(task.channels) {
    for (int c = 0; c < task.channels; ++c) blurred_[c] = ring_.sums(c);
  }

  void run(int j) {
    const int radius = task_.filter.radius();
    for (int k = -radius; k < radius; ++k) take(j, k);
    for (int k = 0; k < task_.size.z; ++k) {
      take(j, k + radius);
      const CellSpan reached = ring_.reached();
      if (!reached.empty()) runWide([&] { ring_.sumAround(k, reached); });
      task_.finish(j, k, reached, blurred_.data());
    }
  }

 private:
  void take(int j, int k) {
    const bool inside = k >= 0 && k < task_.size.z;
    const CellSpan span = inside ? spans_[j + static_cast<std::int64_t>(task_.size.y) * k] : CellSpan{};
    ring_.begin(k, span);
    if (span.empty()) return;
    for (int c = 0; c < task_.channels; ++c) {
      const float* from = task_.memory(c, j, k);
      std::copy(from + span.first, from + span.end, ring_.row(k, c) + span.first);
    }
  }

  const BlurTask& task_;
  const std::vector<CellSpan>& spans_;
  RowRing ring_;
  std::vector<const float*> blurred_;
};

constexpr int tasksPerAxis = 32;  // enough for many cores; each has scratch memory of its own
std::int64_t grainOf(int count) { return (count + tasksPerAxis - 1) / tasksPerAxis; }

}  // namespace

void blurSeparably(const BlurTask& task) {
  CHECK(task.channels == 1 || task.channels == 4, "{} channels", task.channels);
  std::vector<CellSpan> spans(static_cast<std::size_t>(task.size.y) * task.size.z);
  parallelFor(0, task.size.z, grainOf(task.size.z), [&](std::int64_t first, std::int64_t last) {
    LayerBlur blur(task, spans);
    for (int k = static_cast<int>(first); k < last; ++k) blur.run(k);
  });
  parallelFor(0, task.size.y, grainOf(task.size.y), [&](std::int64_t first, std::int64_t last) {
    ColumnBlur blur(task, spans);
    for (int j = static_cast<int>(first); j < last; ++j) blur.run(j);
  });
}

namespace {

template <int channels>
struct Amounts {
  using type = float;
};
template <>
struct Amounts<4> {
  typedef float type __attribute__((vector_size(16), aligned(4), may_alias));
};

/// Adds to one row the points of one bin, of whose shares along y and z the row has those on the given sides.
template <int channels>
inline void addBin(const RowSplat<channels>& splat, std::int64_t bin, bool upperY, bool upperZ, float gain,
                   float* cells, CellSpan& filled) {
  using Amount = typename Amounts<channels>::type;
  for (const auto& point : splat.points.bin(bin)) {
    const auto& [x, y, z] = point.share;
    const float weight = (upperY ? y.fraction : 1 - y.fraction) * (upperZ ? z.fraction : 1 - z.fraction) * gain;
    if (weight == 0) continue;
    const bool two = x.fraction > 0;
    const float left = (1 - x.fraction) * splat.gain[0][x.lower] * weight;
    const float right = two ? x.fraction * splat.gain[0][x.lower + 1] * weight : 0;
    const Amount amount = *reinterpret_cast<const Amount*>(point.amount.data());
    const int cell = x.lower - splat.firstCell;
    Amount* at = reinterpret_cast<Amount*>(cells) + cell;
    at[0] += amount * left;
    at[1] += amount * right;
    filled.include({cell, cell + 1 + two});
  }
}

}  // namespace

template <int channels>
CellSpan RowSplat<channels>::operator()(int j, int k, float* cells) const {
  const std::int64_t rows = std::ssize(gain[1]), bin = j + rows * k;
  const float weight = gain[1][j] * gain[2][k];
  CellSpan filled;
  if (j > 0 && k > 0) addBin(*this, bin - rows - 1, true, true, weight, cells, filled);
  if (k > 0) addBin(*this, bin - rows, false, true, weight, cells, filled);
  if (j > 0) addBin(*this, bin - 1, true, false, weight, cells, filled);
  addBin(*this, bin, false, false, weight, cells, filled);
  return filled;
}

template struct RowSplat<1>;
template struct RowSplat<4>;

}  // namespace brisance
