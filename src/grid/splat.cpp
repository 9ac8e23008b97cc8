#include "grid/splat.h"

#include <utility>

#include "base/vector_path.h"

namespace brisance {

namespace {

/// The channels of a cell and of the one after it.
template <int channels>
struct CellPair {
  typedef float Amounts __attribute__((vector_size(2 * channels * sizeof(float)), aligned(sizeof(float)), may_alias));
};

/// One number for the channels of a cell and another for those of the next.
template <int channels, int... n>
inline void setPair(float left, float right, typename CellPair<channels>::Amounts& pair,
                    std::integer_sequence<int, n...>) {
  using Amounts = typename CellPair<channels>::Amounts;
  pair = __builtin_shufflevector(Amounts{} + left, Amounts{} + right, (n < channels ? n : n + 2 * channels)...);
}

/// The rows around points of one row of lower neighbours: this one, the next along y, and both of the next layer.
struct RowsAround {
  float* cells[4];
  float gain[4];
};

/// What a point gives is amount * (share along x * share along y and z).
template <int channels>
inline CellSpan addPoints(std::span<const SplatPoint<channels>> points, const float* gainX, const RowsAround& rows) {
  using Amounts = typename CellPair<channels>::Amounts;
  const auto pairs = std::make_integer_sequence<int, 2 * channels>();
  int first = points.front().lower, last = first;
  for (const SplatPoint<channels>& point : points) {
    const auto [x, y, z] = point.fraction;
    Amounts amount, share;
    setPair<channels>((1 - x) * gainX[point.lower], x * gainX[point.lower + 1], share, pairs);
    for (int c = 0; c < channels; ++c) amount[c] = amount[channels + c] = point.amount[c];
    const float weight[4] = {(1 - y) * (1 - z), y * (1 - z), (1 - y) * z, y * z};
    for (int row = 0; row < 4; ++row) {
      Amounts* cells = reinterpret_cast<Amounts*>(rows.cells[row] + static_cast<std::int64_t>(channels) * point.lower);
      *cells += amount * (share * (weight[row] * rows.gain[row]));
    }
    first = std::min(first, point.lower);
    last = std::max(last, point.lower);
  }
  return {first, last + 2};
}

}  // namespace

template <int channels>
LayerSplat<channels>::LayerSplat(const Binned<SplatPoint<channels>>& points, std::array<std::vector<float>, 3> gain,
                                 const Vec3i& firstCell)
    : points_(points),
      gain_(std::move(gain)),
      firstCell_(firstCell),
      rowsPerLayer_(static_cast<int>(gain_[1].size())),
      rows_(rowsPerLayer_, static_cast<int>(gain_[2].size())) {
  for (std::vector<float>& cells : gain_) cells.push_back(0);
}

template <int channels>
void LayerSplat<channels>::operator()(const CellSpan& rows, int k, LayerRows& near, LayerRows& far) const {
  runWide([&] {
    const int lowest = std::max(rows.first - 1, -firstCell_.y), end = std::min(rows.end, rowsPerLayer_ - firstCell_.y);
    for (int j = lowest; j < end; ++j) addRow(j, k, near, far);
  });
}

template <int channels>
void LayerSplat<channels>::addRow(int j, int k, LayerRows& near, LayerRows& far) const {
  const int y = j + firstCell_.y, z = k + firstCell_.z;
  const auto points = points_.bin(rows_(y, z));
  if (points.empty()) return;
  const std::int64_t shift = static_cast<std::int64_t>(channels) * firstCell_.x;
  const RowsAround around{{near[j] - shift, near[j + 1] - shift, far[j] - shift, far[j + 1] - shift},
                          {gain_[1][y] * gain_[2][z], gain_[1][y + 1] * gain_[2][z], gain_[1][y] * gain_[2][z + 1],
                           gain_[1][y + 1] * gain_[2][z + 1]}};
  const CellSpan inVolume = addPoints<channels>(points, gain_[0].data(), around);
  const CellSpan filled{inVolume.first - firstCell_.x, inVolume.end - firstCell_.x};
  for (LayerRows* layer : {&near, &far}) {
    layer->hasFilled(j, filled);
    layer->hasFilled(j + 1, filled);
  }
}

template class LayerSplat<1>;
template class LayerSplat<4>;

}  // namespace brisance
