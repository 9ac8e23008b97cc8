#include "fluid/trigonometric_transform.h"

#include <cmath>

#include "base/check.h"
#include "base/vector_path.h"
#include "fluid/paired_lines.h"

namespace brisance {

using detail::Complex;
using detail::ComplexLines;
using detail::lanes;

namespace {
Complex turn(double angle) { return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}; }

std::vector<int> factorsOf(int size) {
  std::vector<int> factors;
  for (const int radix : {4, 2, 3, 5})
    for (; size % radix == 0; size /= radix) factors.push_back(radix);
  return factors;
}

/// The block of `length` samples at `base` holds, once transformed, the frequencies firstFrequency + step t.
void findPlaces(const std::vector<int>& factors, std::size_t stage, int length, int base, int firstFrequency, int step,
                std::vector<int>& place) {
  if (stage == factors.size()) {
    place[firstFrequency] = base;
    return;
  }
  const int radix = factors[stage], part = length / radix;
  for (int p = 0; p < radix; ++p)
    findPlaces(factors, stage + 1, part, base + p * part, firstFrequency + p * step, step * radix, place);
}

/// (Here and below: lanes are independent; a loop over them that is unrolled early is not seen as one vector.)
void copyLanes(const float* from, float sign, float* to) {
#pragma GCC ivdep
#pragma GCC unroll 1
  for (int l = 0; l < lanes; ++l) to[l] = sign * from[l];
}

}  // namespace

detail::ComplexFourier::ComplexFourier(int size_) : size(size_), place(size_) {
  const std::vector<int> factors = factorsOf(size);
  int length = size;
  for (const int radix : factors) {
    FourierStage stage{radix, length, {}};
    for (int j = 0; j < length / radix; ++j)
      for (int p = 1; p < radix; ++p) stage.twiddles.push_back(turn(-2 * pi * p * j / length));
    stages.push_back(stage);
    length /= radix;
  }
  findPlaces(factors, 0, size, 0, 0, 1, place);
}

bool detail::ComplexFourier::takes(int size) {
  for (const int prime : {2, 3, 5})
    while (size % prime == 0) size /= prime;
  return size == 1;
}

AxisEnds axisEnds(FaceKind lower, FaceKind upper) {
  CHECK((lower == FaceKind::periodic) == (upper == FaceKind::periodic));
  if (lower == FaceKind::periodic) return AxisEnds::periodic;
  if (lower == FaceKind::open) return upper == FaceKind::open ? AxisEnds::open : AxisEnds::openThenWall;
  return upper == FaceKind::open ? AxisEnds::wallThenOpen : AxisEnds::walls;
}

double modeValue(AxisEnds ends, int n, int k, int j) {
  switch (ends) {
    case AxisEnds::walls:
      return std::cos(pi * k * (j + 0.5) / n);
    case AxisEnds::open:
      return std::sin(pi * (n - k) * (j + 0.5) / n);
    case AxisEnds::wallThenOpen:
      return std::cos(pi * (k + 0.5) * (j + 0.5) / n);
    case AxisEnds::openThenWall:
      return std::cos(pi * (k + 0.5) * (n - 1 - j + 0.5) / n);
    default:
      return 2 * k <= n ? std::cos(2 * pi * k * j / n) : std::sin(2 * pi * (n - k) * j / n);
  }
}

double modeEigenvalue(AxisEnds ends, int n, int k) {
  const double angle = ends == AxisEnds::walls      ? pi * k / n
                       : ends == AxisEnds::open     ? pi * (n - k) / n
                       : ends == AxisEnds::periodic ? 2 * pi * k / n
                                                    : pi * (k + 0.5) / n;
  const double half = std::sin(angle / 2);
  return 4 * half * half;
}

LineTransform::LineTransform(AxisEnds ends, int n) : ends_(ends), n_(n) {
  if (n % 2 || n < 4 || !detail::ComplexFourier::takes(n / 2)) {
    prepareDirect();
    return;
  }
  fourier_ = detail::ComplexFourier(n / 2);
  if (ends == AxisEnds::wallThenOpen || ends == AxisEnds::openThenWall)
    prepareQuarterWave();
  else
    prepareRealFourier();
}

void LineTransform::prepareRealFourier() {
  method_ = Method::realFourier;
  const int half = n_ / 2;
  const auto rotation = [&](int k) { return ends_ == AxisEnds::periodic ? Complex{1, 0} : turn(-pi * k / (2.0 * n_)); };
  for (int k = 1; 2 * k <= half; ++k) {
    const Complex w = turn(-2 * pi * k / n_), e = rotation(k), f = rotation(half - k);
    const std::int64_t here = fourier_.place[k] * lanes, there = fourier_.place[half - k] * lanes;
    splitting_.push_back({w, 0.5f * e, 0.5f * f, here, there});
    joining_.push_back({w, e, f, here, there});
  }
  middle_ = rotation(half).re;
}

void LineTransform::prepareQuarterWave() {
  method_ = Method::quarterWave;
  for (int k = 0; k < n_ / 2; ++k) rotation_.push_back(turn(-pi * (k + 0.125) / n_));
}

void LineTransform::prepareDirect() {
  method_ = Method::direct;
  forwardMatrix_.resize(static_cast<std::size_t>(n_) * n_);
  inverseMatrix_ = forwardMatrix_;
  for (int k = 0; k < n_; ++k) {
    double squared = 0;
    for (int j = 0; j < n_; ++j) squared += modeValue(ends_, n_, k, j) * modeValue(ends_, n_, k, j);
    for (int j = 0; j < n_; ++j) {
      const double value = modeValue(ends_, n_, k, j);
      forwardMatrix_[k * n_ + j] = static_cast<float>(value);
      inverseMatrix_[j * n_ + k] = static_cast<float>(n_ * value / squared);
    }
  }
}

ComplexLines LineTransform::halves(float* work) const { return {work, work + n_ / 2 * lanes}; }

void LineTransform::forward(const Lines& in, const Lines& out, float* work) const {
  if (method_ == Method::realFourier) return realForward(in, out, work);
  runWide([&] {
    if (method_ == Method::quarterWave) return quarterWave(in, out, work, false);
    direct(in, out, work, forwardMatrix_);
  });
}

void LineTransform::inverse(const Lines& in, const Lines& out, float* work) const {
  if (method_ == Method::realFourier) return realInverse(in, out, work);
  runWide([&] {
    if (method_ == Method::quarterWave) return quarterWave(in, out, work, true);
    direct(in, out, work, inverseMatrix_);
  });
}

/// With t_m = (x_2m + i x_(n-1-2m)) r_m and T its transform, T_k r_k is X_2k - i X_(n-1-2k), r_m = exp(-i pi (m + 1/8)
/// / n). Applied twice it gives n/2 times x. Seen from the other end where the open face comes first.
void LineTransform::quarterWave(const Lines& in, const Lines& out, float* work, bool inverse) const {
  const ComplexLines Z = halves(work);
  const int half = n_ / 2;
  const bool fromEnd = ends_ == AxisEnds::openThenWall;
  transform(fourier_, detail::QuarterSource{in, rotation_.data(), n_, fromEnd && !inverse}, Z);
  const auto output = [&](int j) { return out.samples + (fromEnd && inverse ? n_ - 1 - j : j) * out.stride; };
  for (int k = 0; k < half; ++k) {
    float *a = output(2 * k), *b = output(n_ - 1 - 2 * k);
    const Complex r = (inverse ? 2.0f : 1.0f) * rotation_[k];
    const std::int64_t at = fourier_.place[k] * lanes;
#pragma GCC ivdep
#pragma GCC unroll 1
    for (int l = 0; l < lanes; ++l) {
      const Complex y = r * Z.load(at + l);
      a[l] = y.re;
      b[l] = -y.im;
    }
  }
}

void LineTransform::direct(const Lines& in, const Lines& out, float* work, const std::vector<float>& matrix) const {
  for (int j = 0; j < n_; ++j) copyLanes(detail::sampleAt(in, j), 1, work + j * lanes);
  for (int k = 0; k < n_; ++k) {
    float sum[lanes] = {};
    for (int j = 0; j < n_; ++j) {
      const float factor = matrix[k * n_ + j];
      for (int l = 0; l < lanes; ++l) sum[l] += factor * work[j * lanes + l];
    }
    copyLanes(sum, 1, out.samples + k * out.stride);
  }
}

}  // namespace brisance
