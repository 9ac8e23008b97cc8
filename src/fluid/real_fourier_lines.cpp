// Lines between walls, between open faces, and around: by a real Fourier transform (Makhoul 1980).
#include "base/vector_path.h"
#include "fluid/paired_lines.h"

namespace brisance {

using detail::Complex;
using detail::ComplexLines;
using detail::lanes;
using detail::ModePair;
using detail::PairedLines;
using detail::Pairing;

namespace {

/// Modes k, n - k, n/2 - k and n/2 + k of a line.
struct FourModes {
  float first, last, below, above;
};

// Legend: Z the transform of the pairs v_2m + i v_(2m+1); E and O those of v's even and odd samples, twice, V = E + w O
// that of v; at n/2 - k it is the conjugate of U = E - w O. The cosine and sine parts are +Re and -Im of the rotated V.
// A star, as in `E.im*`, has the sign changed: signs are such that none need be changed on the way.

FourModes split(const ModePair& pair, Complex zHere, Complex zThere) {
  const auto& [w, e, f, here, there] = pair;
  const Complex E{zHere.re + zThere.re, zThere.im - zHere.im};             // E.im*
  const Complex O{zHere.im + zThere.im, zHere.re - zThere.re};             // O.im*
  const Complex wO{w.re * O.re + w.im * O.im, w.re * O.im - w.im * O.re};  // (w O).im*
  const Complex V{E.re + wO.re, E.im + wO.im};                             // V.im*
  const Complex U{E.re - wO.re, wO.im - E.im};
  return {e.re * V.re + e.im * V.im, e.re * V.im - e.im * V.re, f.re * U.re + f.im * U.im, f.re * U.im - f.im * U.re};
}

/// The same backwards.
void join(const ModePair& pair, const FourModes& modes, Complex& zHere, Complex& zThere) {
  const auto& [w, e, f, here, there] = pair;
  const Complex V{e.re * modes.first - e.im * modes.last, e.re * modes.last + e.im * modes.first};  // V.im*
  const Complex U{f.re * modes.below - f.im * modes.above, f.re * modes.above + f.im * modes.below};
  const Complex E{V.re + U.re, U.im - V.im};
  const Complex D{V.re - U.re, V.im + U.im};                              // D = w O, D.im*
  const Complex O{w.re * D.re - w.im * D.im, w.re * D.im + w.im * D.re};  // O.im*
  zHere = {E.re + O.im, O.re + E.im};
  zThere = {E.re - O.im, O.re - E.im};
}

}  // namespace

void LineTransform::toSpectrum(const Lines& in, ComplexLines Z) const {
  const auto from = [&]<Pairing pairing>() { transform(fourier_, PairedLines<pairing, const float>{in, n_ / 2}, Z); };
  if (ends_ == AxisEnds::periodic)
    from.template operator()<Pairing::around>();
  else if (ends_ == AxisEnds::open)
    from.template operator()<Pairing::open>();
  else
    from.template operator()<Pairing::walls>();
}

void LineTransform::fromSpectrum(ComplexLines Z, const Lines& out) const {
  const auto to = [&]<Pairing pairing>() { transformBack(fourier_, Z, PairedLines<pairing, float>{out, n_ / 2}); };
  if (ends_ == AxisEnds::periodic)
    to.template operator()<Pairing::around>();
  else if (ends_ == AxisEnds::open)
    to.template operator()<Pairing::open>();
  else
    to.template operator()<Pairing::walls>();
}

void LineTransform::realForward(const Lines& in, const Lines& out, float* work) const {
  runWide([&] {
    const ComplexLines Z = halves(work);
    const int half = n_ / 2;
    toSpectrum(in, Z);
    const auto to = [&](int k) { return out.samples + k * out.stride; };
    float *first = to(0), *last = to(half);
#pragma GCC ivdep
#pragma GCC unroll 1
    for (int l = 0; l < lanes; ++l) {
      const Complex z = Z.load(l);
      first[l] = z.re + z.im;
      last[l] = middle_ * (z.re - z.im);
    }
    for (int k = 1; 2 * k <= half; ++k) {
      const ModePair& pair = splitting_[k - 1];
      float *a = to(k), *b = to(n_ - k), *c = to(half - k), *d = to(half + k);
#pragma GCC ivdep
#pragma GCC unroll 1
      for (int l = 0; l < lanes; ++l) {
        const FourModes modes = split(pair, Z.load(pair.here + l), Z.load(pair.there + l));
        a[l] = modes.first;
        b[l] = modes.last;
        c[l] = modes.below;
        d[l] = modes.above;
      }
    }
  });
}

void LineTransform::realInverse(const Lines& in, const Lines& out, float* work) const {
  runWide([&] {
    const ComplexLines Z = halves(work);
    const int half = n_ / 2;
    const auto from = [&](int k) { return detail::sampleAt(in, k); };
    const float middle = 1 / middle_;
    const float *first = from(0), *last = from(half);
#pragma GCC ivdep
#pragma GCC unroll 1
    for (int l = 0; l < lanes; ++l) Z.store(l, {first[l] + middle * last[l], first[l] - middle * last[l]});
    for (int k = 1; 2 * k <= half; ++k) {
      const ModePair& pair = joining_[k - 1];
      const float *a = from(k), *b = from(n_ - k), *c = from(half - k), *d = from(half + k);
#pragma GCC ivdep
#pragma GCC unroll 1
      for (int l = 0; l < lanes; ++l) {
        Complex zHere, zThere;
        join(pair, {a[l], b[l], c[l], d[l]}, zHere, zThere);
        Z.store(pair.here + l, zHere);
        Z.store(pair.there + l, zThere);
      }
    }
    fromSpectrum(Z, out);
  });
}

}  // namespace brisance
