// Real lines as the complex ones of a Fourier transform, which takes and leaves their samples where they are.
#pragma once

#include <utility>

#include "fluid/trigonometric_transform.h"

namespace brisance::detail {

/// Sample j of the lines.
inline float* sampleAt(const Lines& lines, int j) {
  float* at = lines.samples + j * lines.stride;
  if (lines.nextFollow) __builtin_prefetch(at + lanes);
  return at;
}

/// How the samples x of a line become those v of a real Fourier transform. around: v = x. walls: x's even samples
/// followed by its odd ones backwards, of which v's transform makes the cosine transform (Makhoul 1980). open: the same
/// with the odd ones' signs changed, which makes it the sine transform.
enum class Pairing { around, walls, open };

/// The samples of a butterfly whose parts are v_2m and v_(2m+1), m = start + p gap. Their addresses follow from p where
/// `radix` is even, so that little is left to do for each butterfly. (Spelt out: what a loop fills does not become
/// registers.)
template <Pairing pairing, int radix, class Sample>
struct PairedSpread {
  static constexpr bool even = radix % 2 == 0;
  Sample *re[radix], *im[radix];
  float signRe[radix], signIm[radix];  ///< in use where `radix` is odd

  Complex load(int p, int l) const { return withSign(p, {re[p][l], im[p][l]}); }
  void store(int p, int l, Complex value) const {
    const Complex x = withSign(p, value);
    re[p][l] = x.re;
    im[p][l] = x.im;
  }
  Complex withSign(int p, Complex value) const {
    if constexpr (pairing != Pairing::open) return value;
    if constexpr (even) return p < radix / 2 ? value : Complex{-value.re, -value.im};
    return {signRe[p] * value.re, signIm[p] * value.im};
  }
};

/// Lines of 2 `size` samples as complex ones of `size`.
template <Pairing pairing, class Sample>
struct PairedLines {
  const Lines& lines;
  int size;

  template <int radix>
  auto spread(int start, int gap) const {
    return spread<radix>(start, gap, std::make_integer_sequence<int, radix>());
  }

 private:
  template <int radix, int... p>
  PairedSpread<pairing, radix, Sample> spread(int start, int gap, std::integer_sequence<int, p...>) const {
    const auto v = [&](int q) { return 2 * (start + q * gap); };
    const auto odd = [&](int q, int number) { return radix % 2 == 0 ? q >= radix / 2 : number >= size; };
    const auto sample = [&](int number, bool isOdd) {
      const int j = pairing == Pairing::around ? number : isOdd ? 4 * size - 1 - 2 * number : 2 * number;
      return sampleAt(lines, j);
    };
    const auto sign = [](bool isOdd) { return isOdd ? -1.0f : 1.0f; };
    return {{sample(v(p), odd(p, v(p)))...},
            {sample(v(p) + 1, odd(p, v(p) + 1))...},
            {sign(odd(p, v(p)))...},
            {sign(odd(p, v(p) + 1))...}};
  }
};

/// Sample m of a transform is (x_2m + i x_(n-1-2m)) times rotation[m]; `fromEnd`: x is read backwards.
struct QuarterSource {
  const Lines& lines;
  const Complex* rotation;
  int n;
  bool fromEnd;

  template <int radix>
  struct Spread {
    const float *re[radix], *im[radix];
    Complex rotation[radix];
    Complex load(int p, int l) const { return rotation[p] * Complex{re[p][l], im[p][l]}; }
  };
  template <int radix>
  Spread<radix> spread(int start, int gap) const {
    return spread(start, gap, std::make_integer_sequence<int, radix>());
  }

 private:
  template <int... p>
  Spread<sizeof...(p)> spread(int start, int gap, std::integer_sequence<int, p...>) const {
    const auto sample = [&](int j) { return sampleAt(lines, fromEnd ? n - 1 - j : j); };
    const auto at = [&](int q) { return start + q * gap; };
    return {{sample(2 * at(p))...}, {sample(n - 1 - 2 * at(p))...}, {rotation[at(p)]...}};
  }
};

}  // namespace brisance::detail
