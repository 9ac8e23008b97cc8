// The modes of the discrete Laplacian along one axis of a box, and transforms of 16 lines at a time to and from them.
#pragma once

#include "fluid/complex_fourier.h"
#include "fluid/fluid_settings.h"

namespace brisance {

/// What bounds an axis below and above: a wall (zero gradient), an open face (p = 0 half a cell beyond the last cell's
/// centre), or the other end.
enum class AxisEnds { walls, open, wallThenOpen, openThenWall, periodic };
/// Trouble: one of a pair of faces is periodic and the other is not (a bug: scenes are checked).
AxisEnds axisEnds(FaceKind lower, FaceKind upper);

/// Mode k at sample j of n. walls: cos(pi k (j + 1/2) / n). open: sin(pi (n - k) (j + 1/2) / n). wallThenOpen:
/// cos(pi (k + 1/2) (j + 1/2) / n), openThenWall the same seen from the other end. periodic: cos(2 pi k j / n) up to
/// k = n / 2, beyond it sin(2 pi (n - k) j / n).
double modeValue(AxisEnds ends, int n, int k, int j);
/// By which -(second difference) multiplies mode k: 0 .. 4.
double modeEigenvalue(AxisEnds ends, int n, int k);

namespace detail {
/// How modes k and n/2 - k of a real Fourier transform follow from the complex one of half the size: w = exp(-2 pi i k
/// / n), the rotations e of mode k and f of n/2 - k, and where the spectrum has both.
struct ModePair {
  Complex w, e, f;
  std::int64_t here, there;
};
}  // namespace detail

/// Samples of lines side by side, 16 for a transform: sample j of line l at samples[j * stride + l].
struct Lines {
  float* samples;
  std::int64_t stride;
  bool nextFollow = false;  ///< the 16 lines beside them are the next to be transformed: they are fetched meanwhile
};

/// Fast for even n with no prime factor beyond 5; other sizes are summed directly, n^2 operations.
class LineTransform {
 public:
  static constexpr int lanes = detail::lanes;
  LineTransform(AxisEnds ends, int n);

  int size() const { return n_; }
  /// Floats of scratch that the transforms ask for, at a cache line.
  std::size_t workSize() const { return static_cast<std::size_t>(n_) * lanes; }
  /// out_k = sum_j in_j mode_k(j). `in` and `out` may be the same.
  void forward(const Lines& in, const Lines& out, float* work) const;
  /// n times the samples whose forward transform is `in`.
  void inverse(const Lines& in, const Lines& out, float* work) const;

 private:
  void prepareRealFourier();
  void prepareQuarterWave();
  void prepareDirect();

  void realForward(const Lines& in, const Lines& out, float* work) const;
  void realInverse(const Lines& in, const Lines& out, float* work) const;
  void toSpectrum(const Lines& in, detail::ComplexLines Z) const;
  void fromSpectrum(detail::ComplexLines Z, const Lines& out) const;
  void quarterWave(const Lines& in, const Lines& out, float* work, bool inverse) const;
  void direct(const Lines& in, const Lines& out, float* work, const std::vector<float>& matrix) const;
  detail::ComplexLines halves(float* work) const;

  enum class Method { realFourier, quarterWave, direct };
  AxisEnds ends_;
  int n_;
  Method method_;
  detail::ComplexFourier fourier_;                     // of size n / 2
  std::vector<detail::ModePair> splitting_, joining_;  // realFourier: for k = 1 .. n / 4
  float middle_ = 1;                                   // realFourier: the rotation of mode n / 2
  std::vector<detail::Complex> rotation_;              // quarterWave: exp(-i pi (k + 1/8) / n)
  std::vector<float> forwardMatrix_, inverseMatrix_;   // direct: n x n
};

}  // namespace brisance
