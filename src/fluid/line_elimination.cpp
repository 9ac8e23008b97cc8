#include "fluid/line_elimination.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "base/vector_path.h"

namespace brisance {

namespace {
constexpr int mostVectors = 4;  ///< side by side, so that none need wait for its own last result
constexpr int mostLines = mostVectors * LineTransform::lanes;
constexpr float noSamples[mostLines] = {};

/// `mostLines` numbers for each sample.
struct Rows {
  float* values;
  float* operator[](int k) const { return values + static_cast<std::int64_t>(k) * mostLines; }
  Rows(AlignedVector<float>& room, int n) {
    room.resize(std::max(room.size(), static_cast<std::size_t>(n) * mostLines));
    values = room.data();
  }
};

/// What is eliminated along an axis of n samples; `below` and `above` is what its ends add to the diagonal.
struct Axis {
  int n;
  float below, above;
  bool periodic;
};

/// `vectors` vectors of lines.
template <int floats, int vectors>
class Strip {
  typedef float Vector __attribute__((vector_size(floats * sizeof(float)), aligned(sizeof(float)), may_alias));
  static const Vector& at(const float* row, int q) { return *reinterpret_cast<const Vector*>(row + q * floats); }
  static Vector& at(float* row, int q) { return *reinterpret_cast<Vector*>(row + q * floats); }

 public:
  static constexpr int lines = floats * vectors;
  Strip(const Axis& axis, const SparseLines& samples, const float* lambda, LineElimination::Scratch& scratch)
      : axis_(axis),
        samples_(samples),
        lambda_(lambda),
        shares_(scratch.shares, axis.n),
        absent_(scratch.absent, samples.present ? axis.n : 0) {}

  void solve(float scale, AlignedVector<float>& corner) {
    findShares();
    eliminate(scale);
    const auto place = [&](int k) { return placeOf(k); };
    substitute(place);
    if (axis_.periodic) closeRing(Rows(corner, axis_.n));
  }

 private:
  const float* sampleOf(int k) const { return samples_.has(k) ? samples_.at(k) : noSamples; }
  float* placeOf(int k) const { return samples_.has(k) ? samples_.at(k) : absent_[k]; }
  const float* shareOf(int k) const { return shares_[std::min(k, lastShare_)]; }

  static bool haveSameBits(const float* a, const float* b) {
    return std::memcmp(a, b, lines * sizeof(float)) == 0;  // NOLINT(bugprone-suspicious-memory-comparison)
  }

  /// Sample k's equation, those before it eliminated, has the pivot 1 + e_k, where e_0 = lambda + below and e_k =
  /// lambda + s_(k-1), s = e / (1 + e): nothing is subtracted, so that the smallest lambda keeps its digits. Writes
  /// s_0, s_1 .. until they change no more.
  void findShares() {
    constexpr int often = 4;
    Vector s[vectors];
    for (int q = 0; q < vectors; ++q) s[q] = Vector{} + axis_.below;
    for (lastShare_ = 0;; ++lastShare_) {
      float* here = shares_[lastShare_];
      for (int q = 0; q < vectors; ++q) {
        const Vector excess = at(lambda_, q) + s[q];
        s[q] = at(here, q) = excess / (1 + excess);
      }
      if (lastShare_ == axis_.n - 1) return;
      if (lastShare_ % often == often - 1 && haveSameBits(here, shares_[lastShare_ - 1])) return;
    }
  }

  /// Legend: d_k the right-hand side of sample k's equation, d_k = b_k + d_(k-1) / (1 + e_(k-1)).
  void eliminate(float scale) const {
    constexpr int ahead = 12;  // planes of memory
    Vector d[vectors];
    for (int q = 0; q < vectors; ++q) d[q] = at(placeOf(0), q) = scale * at(sampleOf(0), q);
    for (int k = 1; k < axis_.n; ++k) {
      const float *b = sampleOf(k), *s = shareOf(k - 1), *later = sampleOf(std::min(k + ahead, axis_.n - 1));
      float* here = placeOf(k);
      for (int l = 0; l < lines; l += LineTransform::lanes) __builtin_prefetch(later + l);
      for (int q = 0; q < vectors; ++q) d[q] = at(here, q) = (scale * at(b, q) + d[q]) - at(s, q) * d[q];
    }
  }

  /// Backwards: x_k = (d_k + x_(k+1)) / (1 + e_k), but for the last.
  template <class Place>
  void substitute(const Place& place) const {
    const int last = axis_.n - 1;
    Vector x[vectors];
    for (int q = 0; q < vectors; ++q) {
      const Vector before = last > 0 ? at(shareOf(last - 1), q) : Vector{} + axis_.below;
      Vector& d = at(place(last), q);
      x[q] = d = d / ((at(lambda_, q) + before) + axis_.above);
    }
    for (int k = last - 1; k >= 0; --k) {
      const float* s = shareOf(k);
      float* here = place(k);
      for (int q = 0; q < vectors; ++q) {
        const Vector sum = at(here, q) + x[q];
        x[q] = at(here, q) = sum - at(s, q) * sum;
      }
    }
  }

  /// Around a periodic axis the matrix is that between walls, T, plus v v^T, v = (1, 0 .. 0, -1) (Sherman & Morrison
  /// 1950): takes c (v . x) / (1 + v . c) from x = b / T, c = v / T.
  void closeRing(Rows corner) const {
    const int last = axis_.n - 1;
    for (int q = 0; q < vectors; ++q) {
      Vector c = Vector{} + 1.0f;
      at(corner[0], q) = c;
      for (int k = 1; k <= last; ++k) c = at(corner[k], q) = c - at(shareOf(k - 1), q) * c;
      at(corner[last], q) -= 1;
    }
    substitute([&](int k) { return corner[k]; });
    for (int q = 0; q < vectors; ++q) {
      const Vector jump = at(placeOf(0), q) - at(placeOf(last), q);
      const Vector factor = jump / (1 + (at(corner[0], q) - at(corner[last], q)));
      for (int k = 0; k <= last; ++k) at(placeOf(k), q) -= factor * at(corner[k], q);
    }
  }

  const Axis axis_;
  const SparseLines samples_;
  const float* lambda_;
  const Rows shares_, absent_;
  int lastShare_ = 0;
};

void takeMean(std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  for (double& value : values) value -= mean;
}

float endOf(bool open) { return open ? 2.0f : 0.0f; }
}  // namespace

LineElimination::LineElimination(AxisEnds ends, int n) : ends_(ends), n_(n) {}

void LineElimination::solve(const SparseLines& lines, const LineEquations& equations, Scratch& scratch) const {
  const Axis axis{n_, endOf(ends_ == AxisEnds::open || ends_ == AxisEnds::openThenWall),
                  endOf(ends_ == AxisEnds::open || ends_ == AxisEnds::wallThenOpen), ends_ == AxisEnds::periodic};
  if (equations.firstIsUndetermined) takeFirst(lines, equations.scale, scratch.first);
  runWithVectors([&]<int floats>() {
    int line = 0;
    const auto strips = [&]<int vectors>() {
      for (constexpr int wide = floats * vectors; line + wide <= equations.count; line += wide)
        Strip<floats, vectors>(axis, {lines.samples + line, lines.stride, lines.present}, equations.lambda + line,
                               scratch)
            .solve(equations.scale, scratch.corner);
    };
    strips.template operator()<mostVectors>();
    strips.template operator()<2>();
    strips.template operator()<1>();
  });
  if (equations.firstIsUndetermined) leaveFirst(lines, scratch.first);
}

/// Line 0 where any constant is a solution: its flux is b's sum, x what the flux has taken away.
void LineElimination::takeFirst(const SparseLines& lines, float scale, std::vector<double>& x) const {
  x.assign(n_, 0.0);
  for (int k = 0; k < n_; ++k)
    if (lines.has(k)) x[k] = double(scale) * lines.at(k)[0];
  takeMean(x);
  std::partial_sum(x.begin(), x.end(), x.begin());
  if (ends_ == AxisEnds::periodic) takeMean(x);
  double next = 0;
  for (double& value : x) value = std::exchange(next, next - value);
  takeMean(x);
}

void LineElimination::leaveFirst(const SparseLines& lines, const std::vector<double>& x) const {
  for (int k = 0; k < n_; ++k)
    if (lines.has(k)) lines.at(k)[0] = static_cast<float>(x[k]);
}

}  // namespace brisance
