// Complex Fourier transforms of 16 lines at once, the inner part of the trigonometric ones. Decimation in frequency
// leaves the spectrum in digit-reversed order, decimation in time takes it back: no reordering pass (Cooley & Tukey
// 1965; Van Loan 1992, chapters 1 and 2).
#pragma once

#include <cstdint>
#include <type_traits>
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

/// What a butterfly takes or leaves: samples `gap` numbers apart.
struct Spread {
  float* re;
  float* im;
  std::int64_t gap;
  Complex load(int p, int l) const { return {re[p * gap + l], im[p * gap + l]}; }
  void store(int p, int l, Complex value) const {
    re[p * gap + l] = value.re;
    im[p * gap + l] = value.im;
  }
};

/// Real and imaginary parts of lines.
struct ComplexLines {
  float* re;
  float* im;
  Complex load(std::int64_t at) const { return {re[at], im[at]}; }
  void store(std::int64_t at, Complex value) const {
    re[at] = value.re;
    im[at] = value.im;
  }
  /// Samples from `start` on, `gap` apart.
  template <int radix>
  Spread spread(int start, int gap) const {
    const std::int64_t at = static_cast<std::int64_t>(start) * lanes;
    return {re + at, im + at, static_cast<std::int64_t>(gap) * lanes};
  }
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
  explicit ComplexFourier(int size);  ///< from 2 on
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

/// Transform of `radix` samples, turned by the twiddles before it (`first`) or after it.
template <int radix, bool first, bool twiddled, class From, class To>
void butterfly(const From& from, const To& to, const Complex* w) {
#pragma GCC ivdep
#pragma GCC unroll 1
  for (int l = 0; l < lanes; ++l) {
    const auto in = [&](int p) {
      return p == 0 ? from.load(p, l) : turned < first && twiddled > (from.load(p, l), w, p);
    };
    const auto out = [&](int p, Complex y) { to.store(p, l, p == 0 ? y : turned < !first && twiddled > (y, w, p)); };
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

template <int radix, bool first, class From, class To>
void runStage(const FourierStage& stage, int size, const From& from, const To& to) {
  const int gap = stage.length / radix;
  const auto at = [&](const auto& lines, int start) { return lines.template spread<radix>(start, gap); };
  for (int start = 0; start < size; start += stage.length)
    butterfly<radix, first, false>(at(from, start), at(to, start), nullptr);
  for (int j = 1; j < gap; ++j) {
    const Complex* w = stage.twiddles.data() + j * (radix - 1);
    for (int start = j; start < size; start += stage.length)
      butterfly<radix, first, true>(at(from, start), at(to, start), w);
  }
}

template <bool first, class From, class To>
void runStage(const FourierStage& stage, int size, const From& from, const To& to) {
  switch (stage.radix) {
    case 2:
      return runStage<2, first>(stage, size, from, to);
    case 3:
      return runStage<3, first>(stage, size, from, to);
    case 4:
      return runStage<4, first>(stage, size, from, to);
    default:
      return runStage<5, first>(stage, size, from, to);
  }
}

/// x_k = sum from_n exp(-2 pi i n k / size), frequency k at place[k]. The first stage takes the samples where they are.
template <class From>
void transform(const ComplexFourier& fourier, const From& from, ComplexLines x) {
  const auto& stages = fourier.stages;
  runStage<false>(stages.front(), fourier.size, from, x);
  for (std::size_t s = 1; s < stages.size(); ++s) runStage<false>(stages[s], fourier.size, x, x);
}

/// Lines whose real parts are another's imaginary ones.
template <class To>
struct Exchanged {
  const To& lines;
  template <class Straight>
  struct Places {
    Straight straight;
    void store(int p, int l, Complex value) const { straight.store(p, l, {value.im, value.re}); }
  };
  template <int radix>
  auto spread(int start, int gap) const {
    const auto places = lines.template spread<radix>(start, gap);
    return Places<std::remove_const_t<decltype(places)>>{places};
  }
};

/// to_n = sum X_k exp(+2 pi i n k / size) of a spectrum with frequency k at place[k], which is lost. Exchanging the
/// real and the imaginary part turns the forward transform into this one. The last stage leaves the samples where they
/// are wanted.
template <class To>
void transformBack(const ComplexFourier& fourier, ComplexLines x, const To& to) {
  const auto& stages = fourier.stages;
  const ComplexLines exchanged{x.im, x.re};
  for (std::size_t s = stages.size() - 1; s > 0; --s) runStage<true>(stages[s], fourier.size, exchanged, exchanged);
  runStage<true>(stages.front(), fourier.size, exchanged, Exchanged<To>{to});
}

}  // namespace brisance::detail
