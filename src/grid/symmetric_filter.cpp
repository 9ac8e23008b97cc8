#include "grid/symmetric_filter.h"

#include <cstdlib>

#include "base/math.h"

namespace brisance {

SymmetricFilter::SymmetricFilter(const std::vector<double>& shape) {
  double sum = shape[0];
  for (std::size_t t = 1; t < shape.size(); ++t) sum += 2 * shape[t];
  for (const double weight : shape) weights_.push_back(static_cast<float>(weight / sum));
}

std::vector<float> SymmetricFilter::gainInside(int count) const {
  std::vector<float> gain(count);
  for (int cell = 0; cell < count; ++cell) {
    double inside = 0;
    for (int t = std::max(-radius(), -cell); t <= std::min(radius(), count - 1 - cell); ++t)
      inside += (*this)(std::abs(t));
    gain[cell] = static_cast<float>(1 / inside);
  }
  return gain;
}

SymmetricFilter gaussianFilter(double deviation, int radius) {
  if (!(deviation > 0)) return {};
  std::vector<double> shape;
  for (int t = 0; t <= radius; ++t) shape.push_back(portableExp(-0.5 * t * t / (deviation * deviation)));
  return SymmetricFilter(shape);
}

}  // namespace brisance
