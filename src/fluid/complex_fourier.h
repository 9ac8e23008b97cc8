// Complex Fourier transforms of 16 lines at once, the inner part of the trigonometric ones. Decimation in frequency
// leaves the spectrum in digit-reversed order, decimation in time takes it back: no reordering pass (Cooley & Tukey
// 1965; Van Loan 1992, chapters 1 and 2).
#pragma once

#include <cstdint>
#include <vector>

namespace brisance::detail {

constexpr int lanes = 16;  ///< sample n of line l lies at n * lanes + l

struct Complex {
  float re, im;
  friend Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
  friend Complex operator-(Complex a, Complex b) { return {a.re - b.re, a.im - b.im}; }
  friend Complex operator*(Complex a, Complex b) { return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }
  friend Complex operator*(float a, Complex b) { return {a * b.re, a * b.im}; }
};
inline Complex conjugate(Complex a) { return {a.re, -a.im}; }
/// a - i b and a + i b
inline Complex minusI(Complex a, Complex b) { return {a.re + b.im, a.im - b.re}; }
inline Complex plusI(Complex a, Complex b) { return {a.re - b.im, a.im + b.re}; }

/// Real and imaginary parts of lines.
struct ComplexLines {
  float* re;
  float* im;
  Complex load(std::int64_t at) const { return {re[at], im[at]}; }
  void store(std::int64_t at, Complex value) const {
    re[at] = value.re;
    im[at] = value.im;
  }
  ComplexLines operator+(std::int64_t samples) const { return {re + samples * lanes, im + samples * lanes}; }
};

/// A stage splits transforms of `length` into `radix` shorter ones; twiddles w^(pj) for j < length / radix, p = 1 ..
struct FourierStage {
  int radix, length;
  std::vector<Complex> twiddles;
};

struct ComplexFourier {
  int size = 0;
  std::vector<FourierStage> stages;
  std::vector<int> place;  ///< of each frequency in the digit-reversed spectrum

  ComplexFourier() = default;
  explicit ComplexFourier(int size);
  /// Whether a size has no prime factor beyond 5.
  static bool takes(int size);
};

/// x times its twiddle, unless that is 1.
template <bool twiddled>
Complex turned(Complex x, const Complex* twiddles, int p) {
  if constexpr (twiddled)
    return x * twiddles[p - 1];
  else
    return x;
}

/// Transform of `radix` samples that lie `gap` samples apart, in place: turned by the twiddles before it (`first`) or
/// after it.
template <int radix, bool first, bool twiddled>
void butterfly(ComplexLines x, int gap, const Complex* w) {
  const std::int64_t g = static_cast<std::int64_t>(gap) * lanes;
#pragma GCC ivdep
  for (int l = 0; l < lanes; ++l) {
    const auto in = [&](int p) { return p == 0 ? x.load(l) : turned < first && twiddled > (x.load(p * g + l), w, p); };
    const auto out = [&](int p, Complex y) {
      x.store(p * g + l, p == 0 ? y : turned < !first && twiddled > (y, w, p));
    };
    if constexpr (radix == 2) {
      const Complex a = in(0), b = in(1);
      out(0, a + b);
      out(1, a - b);
    } else if constexpr (radix == 3) {
      constexpr float sin60 = 0.866025403784438647f;
      const Complex a = in(0), b = in(1), c = in(2);
      const Complex sum = b + c, middle = a - 0.5f * sum, difference = sin60 * (b - c);
      out(0, a + sum);
      out(1, minusI(middle, difference));
      out(2, plusI(middle, difference));
    } else if constexpr (radix == 4) {
      const Complex a = in(0), b = in(1), c = in(2), d = in(3);
      const Complex even = a + c, evenHalf = a - c, odd = b + d, oddHalf = b - d;
      out(0, even + odd);
      out(1, minusI(evenHalf, oddHalf));
      out(2, even - odd);
      out(3, plusI(evenHalf, oddHalf));
    } else {
      constexpr float cos72 = 0.309016994374947424f, cos144 = -0.809016994374947424f;
      constexpr float sin72 = 0.951056516295153572f, sin144 = 0.587785252292473129f;
      const Complex a = in(0), b = in(1), c = in(2), d = in(3), e = in(4);
      const Complex near = b + e, far = c + d, nearHalf = b - e, farHalf = c - d;
      const Complex one = (a + cos72 * near) + cos144 * far, two = (a + cos144 * near) + cos72 * far;
      const Complex turnOne = sin72 * nearHalf + sin144 * farHalf, turnTwo = sin144 * nearHalf - sin72 * farHalf;
      out(0, (a + near) + far);
      out(1, minusI(one, turnOne));
      out(2, minusI(two, turnTwo));
      out(3, plusI(two, turnTwo));
      out(4, plusI(one, turnOne));
    }
  }
}

template <int radix, bool first>
void runStage(const FourierStage& stage, int size, ComplexLines x) {
  const int gap = stage.length / radix;
  for (int start = 0; start < size; start += stage.length) butterfly<radix, first, false>(x + start, gap, nullptr);
  for (int j = 1; j < gap; ++j) {
    Complex w[radix - 1];
    for (int p = 0; p < radix - 1; ++p) w[p] = stage.twiddles[j * (radix - 1) + p];
    for (int start = j; start < size; start += stage.length) butterfly<radix, first, true>(x + start, gap, w);
  }
}

template <bool first>
void runStage(const FourierStage& stage, int size, ComplexLines x) {
  switch (stage.radix) {
    case 2:
      return runStage<2, first>(stage, size, x);
    case 3:
      return runStage<3, first>(stage, size, x);
    case 4:
      return runStage<4, first>(stage, size, x);
    default:
      return runStage<5, first>(stage, size, x);
  }
}

/// sum x_n exp(-2 pi i n k / size), frequency k at place[k].
inline void transform(const ComplexFourier& fourier, ComplexLines x) {
  for (const FourierStage& stage : fourier.stages) runStage<false>(stage, fourier.size, x);
}

/// sum X_k exp(+2 pi i n k / size) of a spectrum with frequency k at place[k]. Exchanging the real and the imaginary
/// part turns the forward transform into this one.
inline void transformBack(const ComplexFourier& fourier, ComplexLines x) {
  const ComplexLines exchanged{x.im, x.re};
  for (auto stage = fourier.stages.rbegin(); stage != fourier.stages.rend(); ++stage)
    runStage<true>(*stage, fourier.size, exchanged);
}

}  // namespace brisance::detail
