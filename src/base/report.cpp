#include "base/report.h"

#include <algorithm>
#include <cmath>

namespace brisance {

double Balance::error() const {
  const double scale = std::max({std::abs(in), std::abs(gained), std::abs(out), std::abs(lost)});
  return scale > 0 ? std::abs(in - gained - out - lost) / scale : 0;
}

Balance& Balance::operator+=(const Balance& other) {
  in += other.in;
  gained += other.gained;
  out += other.out;
  lost += other.lost;
  return *this;
}

}  // namespace brisance
