#include "mesh/box_tree.h"

#include <numeric>

namespace brisance {
namespace {

constexpr std::uint32_t leafSize = 4;

Vec3d doubleCentre(const Box3& box) { return box.lower + box.upper; }

int longestAxis(const Vec3d& size) {
  return size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
}

}  // namespace

BoxTree::BoxTree(std::vector<Box3> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (boxes_.empty()) return;
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(boxes_.size()));
}

void BoxTree::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  Box3 whole, centres;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Box3& box = boxes_[order_[i]];
    whole.include(box.lower);
    whole.include(box.upper);
    centres.include(doubleCentre(box));
  }
  nodes_[node].box = whole;
  if (end - begin <= leafSize) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  const int axis = longestAxis(centres.size());
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    const double ca = doubleCentre(boxes_[a])[axis], cb = doubleCentre(boxes_[b])[axis];
    return ca != cb ? ca < cb : a < b;
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, less);
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = children;
  nodes_.resize(nodes_.size() + 2);
  build(children, begin, middle);
  build(children + 1, middle, end);
}

}  // namespace brisance
