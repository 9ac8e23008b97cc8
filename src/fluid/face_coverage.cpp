#include "fluid/face_coverage.h"

#include <cmath>

namespace brisance {

CoverageSum::CoverageSum(const SquareWindow& window)
    : window_(window),
      area_(static_cast<std::size_t>(window.columns() + 1) * window.rows(), 0.0),
      carry_(area_.size(), 0.0) {}

/// An edge that rises by `rise` at a mean distance bounds, to its right, that much of its square and of all beyond.
void CoverageSum::addInSquare(int p, int q, double rise, double meanP) {
  if (p >= window_.p1) return;
  const bool before = p < window_.p0;
  const int column = before ? window_.p0 : p;
  area_[at(column, q)] += rise * (before ? 1 : p + 1 - meanP);
  carry_[at(column + 1, q)] += rise;
}

void CoverageSum::addInRow(int q, Vec2d from, Vec2d to) {
  const double across = to.x - from.x, up = to.y - from.y;
  const double lower = std::min(from.x, to.x), upper = std::max(from.x, to.x);
  const int first = static_cast<int>(std::floor(std::clamp(lower, window_.p0 - 1.0, window_.p1 + 0.0)));
  const int last = static_cast<int>(std::floor(std::clamp(upper, window_.p0 - 1.0, window_.p1 + 0.0)));
  if (first == last || across == 0) return addInSquare(first, q, up, (from.x + to.x) / 2);
  for (int p = first; p <= last; ++p) {
    const double left = p == first ? lower : p, right = p == last ? upper : p + 1;
    addInSquare(p, q, up * (right - left) / (upper - lower), (left + right) / 2);
  }
}

void CoverageSum::addEdge(Vec2d from, Vec2d to) {
  const double up = to.y - from.y;
  if (up == 0) return;
  const double lower = std::max<double>(window_.q0, std::min(from.y, to.y));
  const double upper = std::min<double>(window_.q1, std::max(from.y, to.y));
  const auto placeAt = [&](double q) {
    return q == from.y ? from : q == to.y ? to : Vec2d{from.x + (to.x - from.x) * ((q - from.y) / up), q};
  };
  for (int q = static_cast<int>(std::floor(lower)); q < upper; ++q) {
    const Vec2d a = placeAt(std::max<double>(lower, q)), b = placeAt(std::min<double>(upper, q + 1));
    if (up > 0)
      addInRow(q, a, b);
    else
      addInRow(q, b, a);
  }
}

void CoverageSum::finish() {
  constexpr double rounding = 1e-9;  // of sums that cancel
  for (int q = window_.q0; q < window_.q1; ++q) {
    double carried = 0;
    for (int p = window_.p0; p < window_.p1; ++p) {
      carried += carry_[at(p, q)];
      const double share = std::min(1.0, std::abs(area_[at(p, q)] + carried));
      area_[at(p, q)] = share < rounding ? 0 : share > 1 - rounding ? 1 : share;
    }
  }
}

}  // namespace brisance
