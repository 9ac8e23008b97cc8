#include "grid/separable_blur.h"

#include <array>

#include "base/check.h"
#include "base/parallel.h"
#include "base/vector_path.h"
#include "grid/blur_kernels.h"

namespace brisance {

namespace {

using blur::rowsAtOnce, blur::Weights, blur::widestFloats;

constexpr int block = blur::pieceAlong;  // what sums along a row are rounded to
constexpr int pieceNumbers = 640;        // of a row, finished at once

constexpr int roundUp(int count, int unit) { return (count + unit - 1) / unit * unit; }
constexpr int roundDown(int count, int unit) { return count / unit * unit; }

/// Numbers of a row of cells and of one more, with room for whole blocks from any vector on.
int rowWidth(const BlurTask& task) { return roundUp(task.channels * (task.size.x + 1), widestFloats) + block; }

/// The numbers of some cells, from the start of a vector on.
struct NumberSpan {
  int first, end;
  NumberSpan(const CellSpan& cells, int channels)
      : first(roundDown(channels * cells.first, widestFloats)), end(channels * cells.end) {}
};

constexpr int cellsBefore = widestFloats;

using Rows = std::array<float*, rowsAtOnce>;

/// Filtered sums of spans of four neighbouring rows; where they go there is room for whole blocks.
class RowFilter {
 public:
  explicit RowFilter(const BlurTask& task)
      : radius_(task.filter.radius()), channels_(task.channels), rows_(2 * radius_ + rowsAtOnce) {
    CHECK(channels_ == 1 || channels_ == 4, "channels {}", channels_);
    const float centre = task.filter(0);
    for (int t = 0; t <= radius_; ++t) {
      relative_.push_back(task.filter(t) / centre);
      completing_.push_back(task.filter(t) * centre * centre);
    }
  }

  /// For sums of four neighbouring rows: row(t) gives that at a distance of -radius .. radius + 3 from the first.
  template <class Row>
  void useRows(const Row& row) {
    for (int t = -radius_; t < radius_ + rowsAtOnce; ++t) rows_[t + radius_] = row(t);
  }
  /// Across rows that were filtered both ways.
  void sumRows(const CellSpan& cells, const Rows& sums) const {
    const NumberSpan span(cells, channels_);
    withFilter<false>(completing_, [&]<int channels>(const auto& filter) {
      runWithVectors([&]<int floats>() {
        blur::sumNeighbours<floats, false>(rows_.data() + radius_, filter, span.first, span.end, sums.data());
      });
    });
  }
  /// Across the rows, of which `filled` cells are not zero, and along them, but for a factor that sumRows() makes up
  /// for: the weight at a distance of 0 is one, which saves products. The first four of the rows become zero.
  /// linesFor(filled) gives lines for what is in between.
  template <class Lines>
  void sumBothWays(const CellSpan& filled, const CellSpan& cells, const Rows& sums, const Lines& linesFor) const {
    withFilter<true>(relative_, [&]<int channels>(const auto& filter) {
      runWithVectors([&]<int floats>() { sumBothWays<floats, channels>(filter, filled, cells, sums, linesFor); });
    });
  }

 private:
  template <int floats, int channels, class Filter, class Lines>
  void sumBothWays(const Filter& filter, const CellSpan& filled, const CellSpan& cells, const Rows& sums,
                   const Lines& linesFor) const {
    const NumberSpan span(cells, channels), before(filled, channels);
    float* const* rows = rows_.data() + radius_;
    if constexpr (blur::shiftsVectors<floats, Filter::fixedRadius>) {
      blur::sumBothWaysShifted<channels>(rows, filter, span.first, span.end, sums.data());
    } else {
      const Rows lines = linesFor(filled);
      blur::sumNeighbours<floats, true>(rows, filter, before.first, before.end, lines.data());
      for (int n = 0; n < rowsAtOnce; ++n)
        blur::sumAlong<floats, channels>(lines[n], filter, span.first, span.end, sums[n]);
    }
  }
  /// Calls visit<channels>(filter) with what the compiler knows of them.
  template <bool centreIsOne, class Visit>
  void withFilter(const std::vector<float>& weights, const Visit& visit) const {
    if (channels_ == 4)
      withRadius<4, centreIsOne>(weights.data(), visit);
    else
      withRadius<1, centreIsOne>(weights.data(), visit);
  }
  template <int channels, bool centreIsOne, class Visit>
  void withRadius(const float* weights, const Visit& visit) const {
    constexpr bool fused = channels == 4;  // a picture's
    const auto withFixed = [&]<int fixedRadius>() {
      visit.template operator()<channels>(Weights<blur::Sums{fixedRadius, centreIsOne, fused}>{weights, radius_});
    };
    switch (radius_) {
      case 1:
        return withFixed.template operator()<1>();
      case 2:
        return withFixed.template operator()<2>();
      case 3:
        return withFixed.template operator()<3>();
      case 4:
        return withFixed.template operator()<4>();
      default:
        return withFixed.template operator()<0>();
    }
  }

  int radius_, channels_;
  std::vector<float> relative_;    // weights over that at a distance of 0
  std::vector<float> completing_;  // times the square of that
  std::vector<float*> rows_;
};

/// Numbers around which there are zeros, as far as a filter along them reaches; zero but for a span.
class PaddedLine {
 public:
  explicit PaddedLine(const BlurTask& task)
      : channels_(task.channels),
        pad_(roundUp(task.channels * task.filter.radius() + 1, widestFloats)),
        values_(static_cast<std::size_t>(rowWidth(task)) + 2 * pad_, 0.f) {}
  /// Where to write `span` of cells; others are zero.
  float* begin(const CellSpan& span) {
    if (span.empty()) {
      clear(filled_.first, filled_.end);
    } else {
      clear(filled_.first, std::min(filled_.end, span.first));
      clear(std::max(filled_.first, span.end), filled_.end);
    }
    filled_ = span;
    return data();
  }
  float* data() { return values_.data() + pad_; }

 private:
  void clear(int first, int end) {
    if (first < end) std::fill(data() + channels_ * first, data() + channels_ * end, 0.f);
  }

  int channels_, pad_;
  CellSpan filled_;
  AlignedVector<float> values_;
};

/// A piece of some rows, and the cells before it: so short that it stays in the nearest cache.
class PieceRows {
 public:
  explicit PieceRows(int channels) : before_(cellsBefore * channels), values_(rowsAtOnce * length()) {}
  /// The rows, of which the numbers from `first` on are there to be written, zeros until then if `clear`, and those
  /// before as they were.
  Rows next(int first, bool clear) {
    Rows rows;
    for (int n = 0; n < rowsAtOnce; ++n) {
      float* row = values_.data() + n * length();
      std::copy(row + pieceNumbers, row + pieceNumbers + before_, row);
      if (clear) std::fill(row + before_, row + before_ + pieceNumbers, 0.f);
      rows[n] = row + before_ - first;
    }
    return rows;
  }

 private:
  /// With room to read whole vectors, or as many cells as come before, where a piece ends.
  int length() const { return before_ + pieceNumbers + std::max(before_, widestFloats); }

  int before_;
  AlignedVector<float> values_;
};

/// One row of the last layers, as many as the filter reaches.
class LayerRing {
 public:
  explicit LayerRing(const BlurTask& task) : slots_(2 * task.filter.radius() + rowsAtOnce) {
    for (int n = 0; n < slots_; ++n) layers_.emplace_back(task);
  }
  /// Layer k in place of the oldest, to be written in `span`.
  float* begin(int k, const CellSpan& span) {
    spans_[slotOf(k)] = span;
    return layers_[slotOf(k)].begin(span);
  }
  float* operator[](int k) { return layers_[slotOf(k)].data(); }
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
/// filter reaches, and blurred along y and x; of the last layers the own rows are kept and blurred along z, four layers
/// at once. So nothing but what is handed out leaves the cache, and rows near another strip are made twice.
class StripBlur {
 public:
  StripBlur(const BlurTask& task, int rows)
      : task_(task),
        radius_(task.filter.radius()),
        near_(roundUp(rows, rowsAtOnce) + 2 * radius_ + 2, task.channels, rowWidth(task)),
        far_(near_),
        filter_(task),
        summed_(rowsAtOnce, PaddedLine(task)),
        unused_(task),
        blurred_(task.channels),
        layers_(rows, LayerRing(task)) {}

  /// Rows first <= j < end, no more than the constructor was told.
  void run(int first, int end) {
    for (LayerRows* layer : {&near_, &far_}) {
      layer->clear();
      layer->numberFrom(first - radius_ - 1);
    }
    int made = -radius_;
    for (int k = 0; k < task_.size.z; k += rowsAtOnce) {
      for (; made < k + rowsAtOnce + radius_; ++made) makeLayer(first, end, made);
      for (int j = first; j < end; ++j) finish(layers_[j - first], j, k);
    }
  }

 private:
  void makeLayer(int first, int end, int k) {
    if (k < 0 || k >= task_.size.z) {
      for (int j = first; j < end; ++j) layers_[j - first].begin(k, {});
      return;
    }
    task_.fill({first - radius_, end + radius_}, k, near_, far_);
    for (int j = first; j < end; j += rowsAtOnce)
      blurLayerRows(&layers_[j - first], j, std::min(rowsAtOnce, end - j), k);
    near_.clear();
    std::swap(near_, far_);
  }

  /// Some rows from j on, along y, then along x.
  void blurLayerRows(LayerRing* layers, int j, int rows, int k) {
    const CellSpan made = near_.filled(j - radius_, j + rowsAtOnce + radius_);
    if (made.empty()) {
      for (int n = 0; n < rows; ++n) layers[n].begin(k, {});
      return;
    }
    const CellSpan reached{std::max(0, made.first - radius_), std::min(task_.size.x, made.end + radius_)};
    Rows sums;
    for (int n = 0; n < rowsAtOnce; ++n) sums[n] = n < rows ? layers[n].begin(k, reached) : unused_.begin(reached);
    filter_.useRows([&](int t) { return near_[j + t]; });
    filter_.sumBothWays(made, reached, sums, [&](const CellSpan& filled) {
      Rows lines;
      for (int n = 0; n < rowsAtOnce; ++n) lines[n] = summed_[n].begin(filled);
      return lines;
    });
    near_.isClear(j - radius_, j - radius_ + rowsAtOnce);
  }

  /// Row j of some layers from k on, piece by piece, so that what takes them mixes stores with the sums' arithmetic.
  void finish(LayerRing& layers, int j, int k) {
    const CellSpan reached = layers.reached();
    filter_.useRows([&](int t) { return layers[k + t]; });
    const int cells = pieceNumbers / task_.channels, rows = std::min(rowsAtOnce, task_.size.z - k);
    for (int first = 0; first < task_.size.x; first += cells) {
      const CellSpan piece{first, std::min(first + cells, task_.size.x)};
      const CellSpan inside{std::max(piece.first, reached.first), std::min(piece.end, reached.end)};
      const bool partly = inside.first > piece.first || inside.end < piece.end;
      const Rows sums = blurred_.next(first * task_.channels, partly);
      filter_.sumRows(inside, sums);
      for (int n = 0; n < rows; ++n) task_.finish(j, k + n, piece, reached, sums[n]);
    }
  }

  const BlurTask& task_;
  int radius_;
  LayerRows near_, far_;
  RowFilter filter_;
  std::vector<PaddedLine> summed_;  ///< across rows
  PaddedLine unused_;               ///< of rows beyond the strip
  PieceRows blurred_;
  std::vector<LayerRing> layers_;  ///< per row of the strip
};

/// As wide as the second cache has room for, since rows near another strip are made twice, and enough strips for the
/// threads.
int rowsPerStrip(const BlurTask& task) {
  constexpr int room = 1 << 17;                                  // numbers
  const int layers = 2 * task.filter.radius() + rowsAtOnce + 2;  // kept of each row
  const int wide = std::max({12, 2 * task.filter.radius(), room / (layers * rowWidth(task))});
  const int share = task.size.y / (2 * threadCount());
  return std::clamp(share, std::min(8, task.size.y), wide);
}

}  // namespace

void blurSeparably(const BlurTask& task) {
  const int rows = rowsPerStrip(task);
  parallelFor(0, (task.size.y + rows - 1) / rows, 1, [&](std::int64_t first, std::int64_t last) {
    StripBlur blur(task, rows);
    for (int strip = static_cast<int>(first); strip < last; ++strip)
      blur.run(strip * rows, std::min((strip + 1) * rows, task.size.y));
    task.finished();
  });
}

}  // namespace brisance
