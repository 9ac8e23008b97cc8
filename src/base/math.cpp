#include "base/math.h"

#include <bit>

namespace brisance {

double portableExp(double x) {
  if (x < -708) return 0;
  if (x > 709) return HUGE_VAL;
  // x = k ln2 + r, |r| <= ln2 / 2; Cody-Waite split of ln2; Taylor of e^(r/2) to r^13, squared.
  constexpr double ln2High = 0x1.62e42fee00000p-1, ln2Low = 0x1.a39ef35793c76p-33, inverseLn2 = 1.4426950408889634074;
  const double k = std::floor(x * inverseLn2 + 0.5);
  const double r = (x - k * ln2High) - k * ln2Low;
  double sum = 1;
  for (int n = 15; n >= 1; --n) sum = 1 + sum * r / n;
  return std::ldexp(sum, static_cast<int>(k));
}

double portableLog(double x) {
  // x = 2^e m, m in [sqrt(1/2), sqrt(2)); log m = 2 atanh(s), s = (m - 1) / (m + 1), |s| < 0.1716.
  int e = 0;
  double m = std::frexp(x, &e);
  if (m < 0.70710678118654752) {
    m *= 2;
    --e;
  }
  const double s = (m - 1) / (m + 1), s2 = s * s;
  double sum = 0;
  for (int n = 21; n >= 3; n -= 2) sum = (sum + 1.0 / n) * s2;
  constexpr double ln2High = 0x1.62e42fee00000p-1, ln2Low = 0x1.a39ef35793c76p-33;
  return e * ln2High + (2 * s + (2 * s * sum + e * ln2Low));
}

SinCos portableSinCos(double radians) {
  // radians = k pi/2 + r, |r| <= pi/4; Taylor to r^17; then turned by quarter circles.
  constexpr double halfPiHigh = 0x1.921fb54400000p+0, halfPiLow = 0x1.0b4611a626331p-34;
  const double k = std::floor(radians / (pi / 2) + 0.5);
  const double r = (radians - k * halfPiHigh) - k * halfPiLow, r2 = r * r;
  double s = 1, c = 1;
  for (int n = 16; n >= 2; n -= 2) {
    s = 1 - s * r2 / (n * (n + 1));
    c = 1 - c * r2 / (n * (n - 1));
  }
  s *= r;
  switch (static_cast<std::int64_t>(k) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double portableAtan2(double y, double x) {
  const double rise = std::abs(y), run = std::abs(x);
  const double longer = std::max(rise, run), shorter = std::min(rise, run);
  if (longer == 0) return 0;
  // The tangent t in [0, 1] lies within 1/16 of k/8: atan t = atan k/8 + atan r, |r| <= 1/16; Taylor to r^13.
  constexpr std::array<double, 9> arcTangentOfEighths{0.0,
                                                      0.12435499454676144,
                                                      0.24497866312686414,
                                                      0.35877067027057225,
                                                      0.4636476090008061,
                                                      0.5585993153435624,
                                                      0.6435011087932844,
                                                      0.7188299996216245,
                                                      0.7853981633974483};
  const double t = shorter / longer, k = std::floor(8 * t + 0.5);
  const double r = (t - k / 8) / (1 + t * k / 8), r2 = r * r;
  constexpr std::array<double, 6> taylor{1.0 / 13, -1.0 / 11, 1.0 / 9, -1.0 / 7, 1.0 / 5, -1.0 / 3};
  double sum = 0;
  for (const double term : taylor) sum = sum * r2 + term;
  double angle = arcTangentOfEighths[static_cast<std::size_t>(k)] + (r + r * r2 * sum);
  if (rise > run) angle = pi / 2 - angle;
  if (x < 0) angle = pi - angle;
  return y < 0 ? -angle : angle;
}

Quaternion axisAngle(const Vec3d& axis, double radians) {
  const auto [s, c] = portableSinCos(radians / 2);
  return {c, axis.x * s, axis.y * s, axis.z * s};
}

}  // namespace brisance
