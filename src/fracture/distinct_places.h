// Places that differ: vertices that are not one must not look like one.
#pragma once

#include <unordered_set>

#include "base/math.h"

namespace brisance {

/// Hands out places on multiples of a step, each at most once.
class DistinctPlaces {
 public:
  explicit DistinctPlaces(double step) : step_(step) {}
  void reserve(std::size_t count) { taken_.reserve(count); }
  /// The multiple nearest to `place`, or one a few steps beside it if that is taken.
  Vec3d take(const Vec3d& place);

 private:
  struct Hash {
    std::size_t operator()(const Vec3d& p) const;
  };
  double step_;
  std::unordered_set<Vec3d, Hash> taken_;
};

}  // namespace brisance
