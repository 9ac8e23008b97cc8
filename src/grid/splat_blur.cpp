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

/// The last rows along an axis, as many as the filter reaches: of each its channels one after the other, with padding
/// around them.
class RowRing {
 public:
  RowRing(const SymmetricFilter& filter, int channels, int cells)
      : filter_(filter),
        channels_(channels),
        pad_(padding(filter.radius())),
        width_(paddedWidth(cells, filter.radius())),
        slots_(2 * filter.radius() + 1),
        rows_(static_cast<std::size_t>(slots_) * channels_ * width_, 0.f),
        spans_(slots_),
        window_(slots_) {}

  /// Makes row n, in the place of the oldest, one that is filled in `span` only; the caller writes all of that. n
  /// counts up from -radius.
  void begin(int n, const CellSpan& span) {
    CellSpan& old = spans_[slotOf(n)];
    if (span.empty() || old.first < span.first || old.end > span.end)
      for (int c = 0; c < channels_; ++c) std::fill(row(n, c) + old.first, row(n, c) + old.end, 0.f);
    old = span;
  }
  /// Of a row that was begun empty: what was written since.
  void hasFilled(int n, const CellSpan& span) { spans_[slotOf(n)] = span; }
  float* row(int n, int channel) { return slot(n) + channel * width_ + pad_; }

  /// The cells that the sums over the rows around n fill: those of all rows.
  CellSpan reached() const {
    CellSpan all;
    for (const CellSpan& span : spans_) all.include(span);
    return all;
  }
  /// Filtered sums over the rows around n, to lines that padding like the rows' own surrounds.
  void sumAround(int n, const CellSpan& span, float* const* lines) {
    const int radius = filter_.radius();
    for (int c = 0; c < channels_; ++c) {
      for (int t = -radius; t <= radius; ++t) window_[t + radius] = row(n + t, c);
      sumSpan(window_.data() + radius, filter_, span, lines[c]);
    }
  }

 private:
  int slotOf(int n) const { return (n + slots_) % slots_; }
  float* slot(int n) { return rows_.data() + static_cast<std::int64_t>(slotOf(n)) * channels_ * width_; }

  SymmetricFilter filter_;
  int channels_, pad_, width_, slots_;
  AlignedVector<float> rows_;
  std::vector<CellSpan> spans_;
  std::vector<const float*> window_;
};

/// Lines of cells for each channel, with padding around them, empty at first.
class Lines {
 public:
  Lines(const SymmetricFilter& filter, int channels, int cells)
      : values_(static_cast<std::size_t>(channels) * paddedWidth(cells, filter.radius()), 0.f) {
    for (int c = 0; c < channels; ++c)
      of_.push_back(values_.data() + c * paddedWidth(cells, filter.radius()) + padding(filter.radius()));
  }
  float* const* data() const { return of_.data(); }
  float* operator[](int channel) const { return of_[channel]; }

 private:
  AlignedVector<float> values_;
  std::vector<float*> of_;
};

/// Blurs some neighbouring rows of all layers. Layer after layer is made, with as many rows beside the own ones as the
/// filter reaches, and blurred along y and x; of the last layers the own rows are kept and blurred along z. So nothing
/// but what is handed out leaves the cache, and rows near another strip are made twice.
class StripBlur {
 public:
  StripBlur(const BlurTask& task, int rows)
      : task_(task),
        made_(task.filter, 1, task.channels * task.size.x),
        summed_(task.filter, 1, task.channels * task.size.x),
        apart_(task.filter, task.channels, task.size.x),
        blurred_(task.filter, task.channels, task.size.x),
        window_(2 * task.filter.radius() + 1),
        layers_(rows, RowRing(task.filter, task.channels, task.size.x)) {}

  /// Rows first <= j < end, no more than the constructor was told.
  void run(int first, int end) {
    const int radius = task_.filter.radius();
    for (int k = -radius; k < task_.size.z + radius; ++k) {
      makeLayer(first, end, k);
      if (k < radius) continue;
      for (int j = first; j < end; ++j) finish(layers_[j - first], j, k - radius);
    }
  }

 private:
  void makeLayer(int first, int end, int k) {
    const int radius = task_.filter.radius();
    if (k < 0 || k >= task_.size.z) {
      for (int j = first; j < end; ++j) layers_[j - first].begin(k, {});
      return;
    }
    for (int j = first - radius; j < end + radius; ++j) {
      made_.begin(j, {});
      if (j >= 0 && j < task_.size.y) {
        const CellSpan span = task_.fill(j, k, made_.row(j, 0));
        made_.hasFilled(j, {span.first * task_.channels, span.end * task_.channels});
      }
      if (const int middle = j - radius; middle >= first) blurLayerRow(layers_[middle - first], middle, k);
    }
  }

  /// Along y, cells side by side; then apart along x.
  void blurLayerRow(RowRing& layers, int j, int k) {
    const CellSpan side = made_.reached();
    if (side.empty()) return layers.begin(k, {});
    const CellSpan made{side.first / task_.channels, side.end / task_.channels};
    const int radius = task_.filter.radius();
    const CellSpan reached{std::max(0, made.first - radius), std::min(task_.size.x, made.end + radius)};
    layers.begin(k, reached);
    runWide([&] {
      made_.sumAround(j, side, summed_.data());
      task_.channels == 4 ? takeApart<4>(made) : takeApart<1>(made);
      for (int c = 0; c < task_.channels; ++c) {
        for (int t = -radius; t <= radius; ++t) window_[t + radius] = apart_[c] + t;
        sumSpan(window_.data() + radius, task_.filter, reached,
                layers.row(k, c));  // what lies beyond the span is not used
        std::fill(apart_[c] + made.first, apart_[c] + made.end, 0.f);
      }
    });
  }

  /// From cells side by side to a line for each channel.
  template <int channels>
  void takeApart(const CellSpan& made) {
    for (int c = 0; c < channels; ++c)
      for (int i = made.first; i < made.end; ++i) apart_[c][i] = summed_[0][channels * i + c];
  }

  void finish(RowRing& layers, int j, int k) {
    const CellSpan reached = layers.reached();
    if (!reached.empty()) runWide([&] { layers.sumAround(k, reached, blurred_.data()); });
    task_.finish(j, k, reached, blurred_.data());
  }

  const BlurTask& task_;
  RowRing made_;  ///< channels side by side
  Lines summed_, apart_, blurred_;
  std::vector<const float*> window_;
  std::vector<RowRing> layers_;  ///< per row of the strip
};

/// Wide enough that few rows are made twice, and enough strips for the threads.
int rowsPerStrip(const BlurTask& task) {
  const int wide = std::max(16, 2 * task.filter.radius()), share = task.size.y / (2 * threadCount());
  return std::clamp(share, std::min(8, task.size.y), wide);
}

}  // namespace

void blurSeparably(const BlurTask& task) {
  CHECK(task.channels == 1 || task.channels == 4, "{} channels", task.channels);
  const int rows = rowsPerStrip(task);
  parallelFor(0, (task.size.y + rows - 1) / rows, 1, [&](std::int64_t first, std::int64_t last) {
    StripBlur blur(task, rows);
    for (int strip = static_cast<int>(first); strip < last; ++strip)
      blur.run(strip * rows, std::min((strip + 1) * rows, task.size.y));
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
