// Real lines as the complex ones of a Fourier transform, which takes and leaves their samples where they are.
#pragma once

#include <utility>

#include "fluid/trigonometric_transform.h"

namespace brisance::detail {

/// Sample j of the lines; the next lines' sample is fetched meanwhile.
inline const float* sampleAt(const Lines& lines, int j) {
  const float* at = lines.samples + j * lines.stride;
  __builtin_prefetch(at + lanes);
  return at;
}

/// The samples of a butterfly: their parts, and what both are multiplied by if `flipped`.
template <class Sample, int radix, bool flipped>
struct PairedSpread {
  Sample *re[radix], *im[radix];
  float signRe[radix], signIm[radix];
  Complex load(int p, int l) const {
    return flipped ? Complex{signRe[p] * re[p][l], signIm[p] * im[p][l]} : Complex{re[p][l], im[p][l]};
  }
  void store(int p, int l, Complex value) const {
    re[p][l] = flipped ? signRe[p] * value.re : value.re;
    im[p][l] = flipped ? signIm[p] * value.im : value.im;
  }
};

/// Sample m of a transform has the samples of a line numbered source[2 m] and source[2 m + 1], times their signs, as
/// its parts.
struct Pairing {
  const int* source;
  const float* sign;

  /// `place`: where sample j is. (Spelt out: what a loop fills does not become registers.)
  template <class Sample, bool flipped, int... p, class Place>
  PairedSpread<Sample, sizeof...(p), flipped> spread(int start, int gap, const Place& place,
                                                     std::integer_sequence<int, p...>) const {
    const auto at = [&](int n) { return 2 * (start + n * gap); };
    return {{place(source[at(p)])...}, {place(source[at(p) + 1])...}, {sign[at(p)]...}, {sign[at(p) + 1]...}};
  }
};

template <bool flipped>
struct PairedSource {
  const Lines& lines;
  Pairing pairing;
  template <int radix>
  auto spread(int start, int gap) const {
    return pairing.spread<const float, flipped>(
        start, gap, [&](int j) { return sampleAt(lines, j); }, std::make_integer_sequence<int, radix>());
  }
};

template <bool flipped>
struct PairedSink {
  const Lines& lines;
  Pairing pairing;
  template <int radix>
  auto spread(int start, int gap) const {
    return pairing.spread<float, flipped>(
        start, gap, [&](int j) { return lines.samples + j * lines.stride; }, std::make_integer_sequence<int, radix>());
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
