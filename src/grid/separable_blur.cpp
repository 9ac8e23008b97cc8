#include "grid/separable_blur.h"

#include "base/parallel.h"
#include "base/vector_path.h"

namespace brisance {

namespace {

constexpr int vectorFloats = 16;  // the widest vectors hold as many
constexpr int blockVectors = 4;   // whose sums stay in registers
constexpr int block = blockVectors * vectorFloats;

constexpr int roundUp(int count, int unit) { return (count + unit - 1) / unit * unit; }
constexpr int roundDown(int count, int unit) { return count / unit * unit; }

/// Numbers of a row of cells and of one more, with room for whole blocks from any vector on.
int rowWidth(const BlurTask& task) { return roundUp(task.channels * (task.size.x + 1), vectorFloats) + block; }

/// Named as vectors, since the compiler would otherwise run along the filter, one cell at a time. Not for `auto`, which
/// forgets that they need not be aligned.
typedef float FloatVector __attribute__((vector_size(vectorFloats * sizeof(float)), aligned(sizeof(float)), may_alias));

/// Filtered sums over rows[-radius] .. rows[radius] of a block of numbers from `at` on.
inline void sumBlock(const float* const* rows, const SymmetricFilter& filter, int at, float* sums) {
  const auto vectors = [at](const float* row) { return reinterpret_cast<const FloatVector*>(row + at); };
  FloatVector sum[blockVectors];
  for (int v = 0; v < blockVectors; ++v) sum[v] = vectors(rows[0])[v] * filter(0);
  for (int t = 1; t <= filter.radius(); ++t) {
    const FloatVector *below = vectors(rows[-t]), *above = vectors(rows[t]);
    for (int v = 0; v < blockVectors; ++v) sum[v] += (below[v] + above[v]) * filter(t);
  }
  for (int v = 0; v < blockVectors; ++v) reinterpret_cast<FloatVector*>(sums + at)[v] = sum[v];
}

/// Filtered sums along x, y or z of a span of cells, according to what rows are given; `sums` has room for whole
/// blocks.
class RowFilter {
 public:
  explicit RowFilter(const BlurTask& task) : filter_(task.filter), channels_(task.channels), rows_(2 * radius() + 1) {}

  /// row(t) gives the row at a distance of -radius .. radius.
  template <class Row>
  void sum(const CellSpan& span, const Row& row, float* sums) {
    for (int t = -radius(); t <= radius(); ++t) rows_[t + radius()] = row(t);
    runWide([&] {
      for (int at = roundDown(channels_ * span.first, vectorFloats); at < channels_ * span.end; at += block)
        sumBlock(rows_.data() + radius(), filter_, at, sums);
    });
  }
  int radius() const { return filter_.radius(); }

 private:
  SymmetricFilter filter_;
  int channels_;
  std::vector<const float*> rows_;
};

/// Numbers around which there are zeros, as far as a filter along them reaches; zero but for a span.
class PaddedLine {
 public:
  explicit PaddedLine(const BlurTask& task)
      : channels_(task.channels),
        pad_(roundUp(task.channels * task.filter.radius(), vectorFloats)),
        values_(static_cast<std::size_t>(rowWidth(task)) + 2 * pad_, 0.f) {}
  /// Where to write `span` of cells; others are zero.
  float* begin(const CellSpan& span) {
    float* cells = data();
    if (filled_.first < span.first || filled_.end > span.end)
      std::fill(cells + channels_ * filled_.first, cells + channels_ * filled_.end, 0.f);
    filled_ = span;
    return cells;
  }
  float* data() { return values_.data() + pad_; }

 private:
  int channels_, pad_;
  CellSpan filled_;
  AlignedVector<float> values_;
};

/// One row of the last layers, as many as the filter reaches.
class LayerRing {
 public:
  explicit LayerRing(const BlurTask& task) : slots_(2 * task.filter.radius() + 1) {
    for (int n = 0; n < slots_; ++n) layers_.emplace_back(task);
  }
  /// Layer k in place of the oldest, to be written in `span`.
  float* begin(int k, const CellSpan& span) {
    spans_[slotOf(k)] = span;
    return layers_[slotOf(k)].begin(span);
  }
  const float* operator[](int k) { return layers_[slotOf(k)].data(); }
  /// The cells that the sums over all layers fill.
  CellSpan reached() const {
    CellSpan all;
    for (const CellSpan& span : spans_) all.include(span);
    return all;
  }

 private:
  int slotOf(int k) const { return (k + slots_) % slots_; }

  int slots_;
  std::vector<PaddedLine> layers_;
  std::vector<CellSpan> spans_ = std::vector<CellSpan>(slots_);
};

/// Blurs some neighbouring rows of all layers. Layer after layer is made, with as many rows beside the own ones as the
/// filter reaches, and blurred along y and x; of the last layers the own rows are kept and blurred along z. So nothing
/// but what is handed out leaves the cache, and rows near another strip are made twice.
class StripBlur {
 public:
  StripBlur(const BlurTask& task, int rows)
      : task_(task),
        radius_(task.filter.radius()),
        near_(rows + 2 * radius_ + 2, task.channels, rowWidth(task)),
        far_(near_),
        filter_(task),
        summed_(task),
        blurred_(static_cast<std::size_t>(rowWidth(task))),
        layers_(rows, LayerRing(task)) {}

  /// Rows first <= j < end, no more than the constructor was told.
  void run(int first, int end) {
    for (LayerRows* layer : {&near_, &far_}) {
      layer->clear();
      layer->numberFrom(first - radius_ - 1);
    }
    for (int k = -radius_; k < task_.size.z + radius_; ++k) {
      makeLayer(first, end, k);
      if (k < radius_) continue;
      for (int j = first; j < end; ++j) finish(layers_[j - first], j, k - radius_);
    }
  }

 private:
  void makeLayer(int first, int end, int k) {
    if (k < 0 || k >= task_.size.z) {
      for (int j = first; j < end; ++j) layers_[j - first].begin(k, {});
      return;
    }
    task_.fill({first - radius_, end + radius_}, k, near_, far_);
    for (int j = first; j < end; ++j) blurLayerRow(layers_[j - first], j, k);
    near_.clear();
    std::swap(near_, far_);
  }

  /// Along y, then along x.
  void blurLayerRow(LayerRing& layers, int j, int k) {
    const CellSpan made = near_.filled(j - radius_, j + radius_ + 1);
    if (made.empty()) {
      layers.begin(k, {});
      return;
    }
    filter_.sum(
        made, [&](int t) { return near_[j + t]; }, summed_.begin(made));
    const CellSpan reached{std::max(0, made.first - radius_), std::min(task_.size.x, made.end + radius_)};
    const float* middle = summed_.data();
    filter_.sum(
        reached, [&](int t) { return middle + task_.channels * t; }, layers.begin(k, reached));
  }

  void finish(LayerRing& layers, int j, int k) {
    const CellSpan reached = layers.reached();
    if (!reached.empty())
      filter_.sum(
          reached, [&](int t) { return layers[k + t]; }, blurred_.data());
    task_.finish(j, k, reached, blurred_.data());
  }

  const BlurTask& task_;
  int radius_;
  LayerRows near_, far_;
  RowFilter filter_;
  PaddedLine summed_;
  AlignedVector<float> blurred_;
  std::vector<LayerRing> layers_;  ///< per row of the strip
};

/// Wide enough that few rows are made twice, and enough strips for the threads.
int rowsPerStrip(const BlurTask& task) {
  const int wide = std::max(16, 2 * task.filter.radius()), share = task.size.y / (2 * threadCount());
  return std::clamp(share, std::min(8, task.size.y), wide);
}

}  // namespace

void blurSeparably(const BlurTask& task) {
  const int rows = rowsPerStrip(task);
  parallelFor(0, (task.size.y + rows - 1) / rows, 1, [&](std::int64_t first, std::int64_t last) {
    StripBlur blur(task, rows);
    for (int strip = static_cast<int>(first); strip < last; ++strip)
      blur.run(strip * rows, std::min((strip + 1) * rows, task.size.y));
  });
}

}  // namespace brisance
