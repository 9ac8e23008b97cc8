#include "fracture/nearest_point.h"

namespace brisance {
namespace {

int longestAxis(const Vec3d& size) {
  const int axis = size.x >= size.y ? 0 : 1;
  return size[axis] >= size.z ? axis : 2;
}

double distance2(const Vec3d& a, const Vec3d& b) { return dot(a - b, a - b); }

}  // namespace

PointTree::PointTree(std::vector<Entry> entries) : entries_(std::move(entries)), axis_(entries_.size(), 0) {
  build(0, entries_.size());
}

void PointTree::build(std::size_t begin, std::size_t end) {
  if (end - begin <= leafSize) return;
  Box3 box;
  for (std::size_t i = begin; i < end; ++i) box.include(entries_[i].place);
  const int axis = longestAxis(box.size());
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return entries_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [axis](const Entry& a, const Entry& b) { return a.place[axis] < b.place[axis]; });
  axis_[middle] = static_cast<std::uint8_t>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

void PointTree::search(const Vec3d& from, std::size_t begin, std::size_t end, Nearest& nearest) const {
  if (end - begin <= leafSize) {
    for (std::size_t i = begin; i < end; ++i) nearest.offer(distance2(from, entries_[i].place), entries_[i].id);
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const Entry& entry = entries_[middle];
  nearest.offer(distance2(from, entry.place), entry.id);
  const double beyond = from[axis_[middle]] - entry.place[axis_[middle]];
  const bool below = beyond < 0;
  search(from, below ? begin : middle + 1, below ? middle : end, nearest);
  if (beyond * beyond <= nearest.distance2) search(from, below ? middle + 1 : begin, below ? end : middle, nearest);
}

void GrowingPoints::add(const Vec3d& place, std::uint32_t id) {
  std::vector<PointTree::Entry> entries{{place, id}};
  while (!trees_.empty() && trees_.back().entries().size() == entries.size()) {
    entries.insert(entries.end(), trees_.back().entries().begin(), trees_.back().entries().end());
    trees_.pop_back();
  }
  trees_.emplace_back(std::move(entries));
}

Nearest GrowingPoints::nearest(const Vec3d& from) const {
  Nearest result;
  for (const PointTree& tree : trees_) tree.search(from, result);
  return result;
}

}  // namespace brisance
