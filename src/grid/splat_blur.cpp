#include "grid/splat_blur.h"

#include <cstring>

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

/// Pointers to the rows of a window; index 0 is its middle.
class RowWindow {
 public:
  explicit RowWindow(int radius) : radius_(radius), rows_(2 * radius + 1) {}
  const float*& operator[](int t) { return rows_[t + radius_]; }
  const float* const* middle() const { return rows_.data() + radius_; }

 private:
  int radius_;
  std::vector<const float*> rows_;
};

}  // namespace

SplatLayer::SplatLayer(const Vec3i& size, int channels, int radius)
    : stride_(static_cast<std::int64_t>(channels) * paddedWidth(size.x, radius)),
      values_(static_cast<std::size_t>(stride_) * size.y, 0.f),
      used_(size.y) {}

void SplatLayer::clear() {
  for (int j = 0; j < static_cast<int>(used_.size()); ++j) {
    if (used_[j].empty()) continue;
    std::fill_n(row(j), stride_, 0.f);
    used_[j] = {};
  }
}

/// Blurs one layer along x and y. Along x each row goes from cells side by side to channels side by side, each channel
/// with its padding.
class LayerBlur {
 public:
  LayerBlur(const BlurTask& task, std::vector<CellSpan>& spans)
      : task_(task),
        spans_(spans),
        pad_(padding(task.filter.radius())),
        width_(paddedWidth(task.size.x, task.filter.radius())),
        lines_(static_cast<std::size_t>(task.channels) * width_, 0.f),
        empty_(static_cast<std::size_t>(task.channels) * width_, 0.f),
        sums_(width_, 0.f),
        window_(task.filter.radius()) {}

  void run(int k, SplatLayer& layer) {
    for (int j = 0; j < task_.size.y; ++j)
      if (!layer.used_[j].empty()) alongX(layer.row(j), layer.used_[j]);
    for (int j = 0; j < task_.size.y; ++j) alongY(layer, j, k);
  }

 private:
  CellSpan widened(const CellSpan& span) const {
    const int radius = task_.filter.radius();
    return {std::max(0, span.first - radius), std::min(task_.size.x, span.end + radius)};
  }

  /// From cells side by side to a line for each channel.
  template <int channels>
  void takeApart(const float* row, const CellSpan& used) {
    for (int c = 0; c < channels; ++c) {
      float* line = lines_.data() + c * width_ + pad_;
      for (int i = used.first; i < used.end; ++i) line[i] = row[channels * i + c];
    }
  }

  void alongX(float* row, CellSpan& used) {
    const int channels = task_.channels, radius = task_.filter.radius();
    const CellSpan reached = widened(used);
    channels == 4 ? takeApart<4>(row, used) : takeApart<1>(row, used);
    std::fill(row + channels * used.first, row + channels * used.end, 0.f);
    for (int c = 0; c < channels; ++c) {
      float* line = lines_.data() + c * width_ + pad_;
      for (int t = -radius; t <= radius; ++t) window_[t] = line + t;
      sumSpan(window_.middle(), task_.filter, reached, row + c * width_ + pad_);  // beyond the span they are not used
      std::fill(line + used.first, line + used.end, 0.f);
    }
    used = reached;
  }

  void alongY(const SplatLayer& layer, int j, int k) {
    const int radius = task_.filter.radius();
    CellSpan reached;
    for (int t = std::max(-radius, -j); t <= std::min(radius, task_.size.y - 1 - j); ++t)
      reached.include(layer.used_[j + t]);
    spans_[j + static_cast<std::int64_t>(task_.size.y) * k] = reached;
    if (reached.empty()) return;
    for (int c = 0; c < task_.channels; ++c) {
      for (int t = -radius; t <= radius; ++t) {
        const bool used = j + t >= 0 && j + t < task_.size.y && !layer.used_[j + t].empty();
        window_[t] = (used ? layer.row(j + t) : empty_.data()) + c * width_ + pad_;
      }
      sumSpan(window_.middle(), task_.filter, reached, sums_.data());
      std::memcpy(task_.memory(c, j, k) + reached.first, sums_.data() + reached.first,
                  sizeof(float) * (reached.end - reached.first));
    }
  }

  const BlurTask& task_;
  std::vector<CellSpan>& spans_;
  int pad_, width_;
  AlignedVector<float> lines_, empty_, sums_;
  RowWindow window_;
};

namespace {

/// Blurs the rows of one j along z and hands them out: the rows of the window are copies, since the place of the
/// finished ones is the caller's to use.
class ColumnBlur {
 public:
  ColumnBlur(const BlurTask& task, const std::vector<CellSpan>& spans)
      : task_(task),
        spans_(spans),
        pad_(padding(task.filter.radius())),
        width_(paddedWidth(task.size.x, task.filter.radius())),
        slots_(2 * task.filter.radius() + 1),
        copies_(static_cast<std::size_t>(rowFloats()) * slots_, 0.f),
        copied_(slots_),
        sums_(rowFloats(), 0.f),
        blurred_(task.channels),
        window_(task.filter.radius()) {
    for (int c = 0; c < task.channels; ++c) blurred_[c] = sums_.data() + c * width_ + pad_;
  }

  void run(int j) {
    const int radius = task_.filter.radius(), layers = task_.size.z;
    for (int k = -radius; k < radius; ++k) take(j, k);
    for (int k = 0; k < layers; ++k) {
      take(j, k + radius);
      CellSpan reached;
      for (const CellSpan& span : copied_) reached.include(span);
      if (!reached.empty()) runWide([&] { sum(k, reached); });
      task_.finish(j, k, reached, blurred_.data());
    }
  }

 private:
  std::int64_t rowFloats() const { return static_cast<std::int64_t>(task_.channels) * width_; }
  int slotOf(int k) const { return (k + slots_) % slots_; }
  float* copy(int k, int channel) { return copies_.data() + rowFloats() * slotOf(k) + channel * width_ + pad_; }

  /// Copies row (j, k), empty outside the layers, into its slot of the ring.
  void take(int j, int k) {
    CellSpan& old = copied_[slotOf(k)];
    const bool inside = k >= 0 && k < task_.size.z;
    const CellSpan span = inside ? spans_[j + static_cast<std::int64_t>(task_.size.y) * k] : CellSpan{};
    for (int c = 0; c < task_.channels; ++c) {
      float* to = copy(k, c);
      if (span.empty() || old.first < span.first || old.end > span.end) std::fill(to + old.first, to + old.end, 0.f);
      if (span.empty()) continue;
      const float* from = task_.memory(c, j, k);
      std::memcpy(to + span.first, from + span.first, sizeof(float) * (span.end - span.first));
    }
    old = span;
  }

  void sum(int k, const CellSpan& reached) {
    for (int c = 0; c < task_.channels; ++c) {
      for (int t = -task_.filter.radius(); t <= task_.filter.radius(); ++t) window_[t] = copy(k + t, c);
      sumSpan(window_.middle(), task_.filter, reached, sums_.data() + c * width_ + pad_);
    }
  }

  const BlurTask& task_;
  const std::vector<CellSpan>& spans_;
  int pad_, width_, slots_;
  AlignedVector<float> copies_;
  std::vector<CellSpan> copied_;
  AlignedVector<float> sums_;
  std::vector<const float*> blurred_;
  RowWindow window_;
};

constexpr int tasksPerAxis = 32;  // enough for many cores; each has scratch memory of its own
std::int64_t grainOf(int count) { return (count + tasksPerAxis - 1) / tasksPerAxis; }

}  // namespace

void blurSeparably(const BlurTask& task) {
  CHECK(task.channels == 1 || task.channels == 4, "{} channels", task.channels);
  std::vector<CellSpan> spans(static_cast<std::size_t>(task.size.y) * task.size.z);
  parallelFor(0, task.size.z, grainOf(task.size.z), [&](std::int64_t first, std::int64_t last) {
    SplatLayer layer(task.size, task.channels, task.filter.radius());
    LayerBlur blur(task, spans);
    for (int k = static_cast<int>(first); k < last; ++k) {
      task.fill(k, layer);
      runWide([&] { blur.run(k, layer); });
      layer.clear();
    }
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

/// Adds a point's shares of two rows to one layer, times `weight`.
template <int channels>
inline void addPoint(const LayerSplat<channels>& splat, const SplatPoint<channels>& point, float weight,
                     SplatLayer& layer) {
  using Vector = typename Amounts<channels>::type;
  const auto& [x, y, z] = point.share;
  const Vector amount = *reinterpret_cast<const Vector*>(point.amount.data()) * weight;
  const float left = (1 - x.fraction) * splat.gain[0][x.lower];
  const float right = x.fraction > 0 ? x.fraction * splat.gain[0][x.lower + 1] : 0;
  const int cell = x.lower - splat.firstCell;
  const CellSpan span{cell, cell + (x.fraction > 0 ? 2 : 1)};
  const auto addToRow = [&](int j, float share) {
    const float shareOfRow = share * splat.gain[1][j];
    Vector* cells = reinterpret_cast<Vector*>(layer.row(j - splat.firstRow)) + cell;
    cells[0] += amount * (shareOfRow * left);
    cells[1] += amount * (shareOfRow * right);
    layer.use(j - splat.firstRow, span);
  };
  addToRow(y.lower, 1 - y.fraction);
  if (y.fraction > 0) addToRow(y.lower + 1, y.fraction);
}

}  // namespace

template <int channels>
void LayerSplat<channels>::operator()(int k, SplatLayer& layer) const {
  if (k > 0)
    for (const auto& point : points.bin(k - 1))
      if (point.share[2].fraction > 0) addPoint(*this, point, point.share[2].fraction * gain[2][k], layer);
  for (const auto& point : points.bin(k)) addPoint(*this, point, (1 - point.share[2].fraction) * gain[2][k], layer);
}

template struct LayerSplat<1>;
template struct LayerSplat<4>;

}  // namespace brisance
