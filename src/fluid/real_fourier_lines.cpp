// Lines between walls, between open faces, and around: by a real Fourier transform (Makhoul 1980).
#include "base/vector_path.h"
#include "fluid/paired_lines.h"

namespace brisance {

using detail::Complex;
using detail::ComplexLines;
using detail::conjugate;
using detail::lanes;

namespace {

/// Rotations of the modes k and n/2 - k. Legend: Z the transform of the pairs v_2m + i v_2m+1; E and O those of v's
/// even and odd samples, V = E + w^k O that of v; at n/2 - k it is the conjugate of E - w^k O. The cosine and sine
/// parts are +Re and -Im of the rotated V.
struct ModePair {
  Complex w, e, f;

  /// Of Z at k and at n/2 - k.
  void split(Complex zHere, Complex zThere, Complex& V, Complex& U) const {
    const Complex y = conjugate(zThere), E = zHere + y, difference = zHere - y, O{difference.im, -difference.re};
    const Complex T = w * O;
    V = (0.5f * e) * (E + T);
    U = (0.5f * f) * conjugate(E - T);
  }
  /// The same backwards; twice E and O are kept, which with the n/2 of transformBack makes the factor n.
  void join(Complex V, Complex U, Complex& zHere, Complex& zThere) const {
    const Complex turnedBack = conjugate(e) * V, other = conjugate(conjugate(f) * U);
    const Complex E = turnedBack + other, O = conjugate(w) * (turnedBack - other);
    zHere = plusI(E, O);
    zThere = plusI(conjugate(E), conjugate(O));
  }
};

}  // namespace

void LineTransform::toSpectrum(const Lines& in, ComplexLines Z) const {
  const detail::Pairing pairing{source_.data(), sign_.data()};
  if (ends_ == AxisEnds::open)
    transform(fourier_, detail::PairedSource<true>{in, pairing}, Z);
  else
    transform(fourier_, detail::PairedSource<false>{in, pairing}, Z);
}

void LineTransform::fromSpectrum(ComplexLines Z, const Lines& out) const {
  const detail::Pairing pairing{source_.data(), sign_.data()};
  if (ends_ == AxisEnds::open)
    transformBack(fourier_, Z, detail::PairedSink<true>{out, pairing});
  else
    transformBack(fourier_, Z, detail::PairedSink<false>{out, pairing});
}

void LineTransform::realForward(const Lines& in, const Lines& out, float* work) const {
  runWide([&] {
    const ComplexLines Z = halves(work);
    const int half = n_ / 2;
    toSpectrum(in, Z);
    const auto to = [&](int k) { return out.samples + k * out.stride; };
    const float middle = rotation_[half].re;
    float *first = to(0), *last = to(half);
#pragma GCC ivdep
#pragma GCC unroll 1
    for (int l = 0; l < lanes; ++l) {
      const Complex z = Z.load(l);
      first[l] = z.re + z.im;
      last[l] = middle * (z.re - z.im);
    }
    for (int k = 1; 2 * k <= half; ++k) {
      const std::int64_t here = fourier_.place[k] * lanes, there = fourier_.place[half - k] * lanes;
      const ModePair pair{split_[k], rotation_[k], rotation_[half - k]};
      float *a = to(k), *b = to(n_ - k), *c = to(half - k), *d = to(half + k);
#pragma GCC ivdep
#pragma GCC unroll 1
      for (int l = 0; l < lanes; ++l) {
        Complex V, U;
        pair.split(Z.load(here + l), Z.load(there + l), V, U);
        a[l] = V.re;
        b[l] = -V.im;
        c[l] = U.re;
        d[l] = -U.im;
      }
    }
  });
}

void LineTransform::realInverse(const Lines& in, const Lines& out, float* work) const {
  runWide([&] {
    const ComplexLines Z = halves(work);
    const int half = n_ / 2;
    const auto from = [&](int k) { return in.samples + k * in.stride; };
    const float middle = 1 / rotation_[half].re;
    const float *first = from(0), *last = from(half);
#pragma GCC ivdep
#pragma GCC unroll 1
    for (int l = 0; l < lanes; ++l) Z.store(l, {first[l] + middle * last[l], first[l] - middle * last[l]});
    for (int k = 1; 2 * k <= half; ++k) {
      const std::int64_t here = fourier_.place[k] * lanes, there = fourier_.place[half - k] * lanes;
      const ModePair pair{split_[k], rotation_[k], rotation_[half - k]};
      const float *a = from(k), *b = from(n_ - k), *c = from(half - k), *d = from(half + k);
#pragma GCC ivdep
#pragma GCC unroll 1
      for (int l = 0; l < lanes; ++l) {
        Complex zHere, zThere;
        pair.join({a[l], -b[l]}, {c[l], -d[l]}, zHere, zThere);
        Z.store(here + l, zHere);
        Z.store(there + l, zThere);
      }
    }
    fromSpectrum(Z, out);
  });
}

}  // namespace brisance
