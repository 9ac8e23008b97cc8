// Boxes found by what they meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/math.h"

namespace brisance {

/// A binary tree over boxes, halved along the longest side of their centres.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box3> boxes);

  /// Calls visit(number) for each box that `meets(box)`, a test that never denies a box around one it grants. Stops
  /// when visit says false. Returns how many boxes were looked at.
  template <class Meets, class Visit>
  std::size_t search(const Meets& meets, const Visit& visit) const {
    std::size_t looked = 0;
    std::uint32_t open[64], size = 0;  // halving keeps the tree's depth below 32
    if (!nodes_.empty()) open[size++] = 0;
    while (size > 0) {
      const Node& node = nodes_[open[--size]];
      ++looked;
      if (!meets(node.box)) continue;
      if (node.count == 0) {
        open[size++] = node.first + 1;
        open[size++] = node.first;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        ++looked;
        if (meets(boxes_[order_[i]]) && !visit(order_[i])) return looked;
      }
    }
    return looked;
  }

 private:
  struct Node {
    Box3 box;
    std::uint32_t first = 0;  ///< box of the leaf in order_, or the first of two child nodes
    std::uint32_t count = 0;  ///< 0: an inner node
  };
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);

  std::vector<Box3> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

inline bool overlap(const Box3& a, const Box3& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.lower[axis] > b.upper[axis] || b.lower[axis] > a.upper[axis]) return false;
  return true;
}

}  // namespace brisance
