// Edges of a planar graph that know their neighbours around each end: what Delaunay's divide and conquer works on.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace brisance {

constexpr std::uint32_t noPoint = 0xFFFFFFFFu;

/// Places for edges, handed out again once their edge is removed.
struct EdgePool {
  std::vector<std::uint32_t> freed;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> unused;  ///< ranges [first, last) of edges

  std::uint32_t take() {
    if (!freed.empty()) {
      const std::uint32_t edge = freed.back();
      freed.pop_back();
      return edge;
    }
    while (unused.back().first == unused.back().second) unused.pop_back();
    return unused.back().first++;
  }
  void join(EdgePool&& other) {
    freed.insert(freed.end(), other.freed.begin(), other.freed.end());
    unused.insert(unused.end(), other.unused.begin(), other.unused.end());
    other = {};
  }
};

/// Every edge is two directed sides 2 e and 2 e + 1, each in the ring of sides that leave the same point.
/// (Guibas & Stolfi 1985, without the dual: `connect`, `remove` and the names of the turns are theirs.)
class EdgeNet {
 public:
  explicit EdgeNet(std::size_t edgeCount) : sides_(2 * edgeCount) {}

  static std::uint32_t twin(std::uint32_t side) { return side ^ 1u; }
  std::uint32_t origin(std::uint32_t side) const { return sides_[side].origin; }
  std::uint32_t target(std::uint32_t side) const { return sides_[twin(side)].origin; }
  std::uint32_t next(std::uint32_t side) const { return sides_[side].next; }          ///< counter-clockwise
  std::uint32_t previous(std::uint32_t side) const { return sides_[side].previous; }  ///< clockwise
  /// The following side of the face to the left.
  std::uint32_t leftNext(std::uint32_t side) const { return previous(twin(side)); }
  /// The side that leaves the target along the face to the right.
  std::uint32_t rightOnward(std::uint32_t side) const { return next(twin(side)); }
  bool exists(std::uint32_t side) const { return sides_[side].origin != noPoint; }
  std::uint32_t sideCount() const { return static_cast<std::uint32_t>(sides_.size()); }

  std::uint32_t add(EdgePool& pool, std::uint32_t from, std::uint32_t to) {
    const std::uint32_t side = 2 * pool.take();
    sides_[side] = {from, side, side};
    sides_[twin(side)] = {to, twin(side), twin(side)};
    return side;
  }
  /// Puts a side that is alone around its origin right after another.
  void insertAfter(std::uint32_t place, std::uint32_t side) {
    const std::uint32_t after = next(place);
    sides_[place].next = side;
    sides_[side].previous = place;
    sides_[side].next = after;
    sides_[after].previous = side;
  }
  /// From the target of `a` to the origin of `b`, both along one left face, which it divides.
  std::uint32_t connect(EdgePool& pool, std::uint32_t a, std::uint32_t b) {
    const std::uint32_t side = add(pool, target(a), origin(b));
    insertAfter(leftNext(a), side);
    insertAfter(b, twin(side));
    return side;
  }
  void remove(EdgePool& pool, std::uint32_t side) {
    for (const std::uint32_t s : {side, twin(side)}) {
      sides_[previous(s)].next = next(s);
      sides_[next(s)].previous = previous(s);
      sides_[s].origin = noPoint;
    }
    pool.freed.push_back(side / 2);
  }

 private:
  struct Side {
    std::uint32_t origin = noPoint, next = 0, previous = 0;
  };
  std::vector<Side> sides_;
};

}  // namespace brisance
