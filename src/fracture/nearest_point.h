// Which of many points is nearest.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "base/math.h"

namespace brisance {

struct Nearest {
  double distance2 = std::numeric_limits<double>::infinity();  ///< squared [m2]
  std::uint32_t id = 0xFFFFFFFFu;
  /// Of equally near ones the lowest id: independent of how the search went.
  void offer(double other2, std::uint32_t otherId) {
    if (other2 < distance2 || (other2 == distance2 && otherId < id)) *this = {other2, otherId};
  }
};

/// A k-d tree (Bentley 1975): each range of points is split at the median of its longest extent.
class PointTree {
 public:
  struct Entry {
    Vec3d place;
    std::uint32_t id;
  };
  explicit PointTree(std::vector<Entry> entries);
  void search(const Vec3d& from, Nearest& nearest) const { search(from, 0, entries_.size(), nearest); }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  static constexpr std::size_t leafSize = 8;
  void build(std::size_t begin, std::size_t end);
  void search(const Vec3d& from, std::size_t begin, std::size_t end, Nearest& nearest) const;
  std::vector<Entry> entries_;
  std::vector<std::uint8_t> axis_;  ///< by the median's place
};

/// Points that become more and more: a tree for each binary digit of their count (Bentley & Saxe 1980).
class GrowingPoints {
 public:
  void add(const Vec3d& place, std::uint32_t id);
  Nearest nearest(const Vec3d& from) const;

 private:
  std::vector<PointTree> trees_;  ///< from the largest to the smallest
};

}  // namespace brisance
