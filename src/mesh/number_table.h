// Numbers by content: equal things found again in constant time.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "base/math.h"

namespace brisance {

/// Mixes a word into a hash (the finaliser of SplitMix64: Steele, Lea & Flood 2014).
inline std::uint64_t mixHash(std::uint64_t hash, std::uint64_t word) {
  hash ^= word + 0x9E3779B97F4A7C15u + (hash << 6) + (hash >> 2);
  hash = (hash ^ (hash >> 30)) * 0xBF58476D1CE4E5B9u;
  hash = (hash ^ (hash >> 27)) * 0x94D049BB133111EBu;
  return hash ^ (hash >> 31);
}

/// Of a place; 0 and -0 are one.
inline std::uint64_t hashOf(const Vec3d& p) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) hash = mixHash(hash, std::bit_cast<std::uint64_t>(p[axis] + 0.0));
  return hash;
}

/// An open-addressing table of the numbers of things that live elsewhere.
class NumberTable {
 public:
  explicit NumberTable(std::size_t expected = 0) : entries_(std::bit_ceil(2 * expected + 16)) {}

  /// The number of an equal thing entered before, or `fresh`, which is entered. `equal(n)` compares with thing n.
  template <class Equal>
  std::uint32_t findOrAdd(std::uint64_t hash, std::uint32_t fresh, const Equal& equal) {
    if (2 * (count_ + 1) > entries_.size()) grow();
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    std::size_t slot = hash & (entries_.size() - 1);
    for (; entries_[slot].number != vacant; slot = (slot + 1) & (entries_.size() - 1))
      if (entries_[slot].tag == tag && equal(entries_[slot].number)) return entries_[slot].number;
    entries_[slot] = {fresh, tag, hash};
    ++count_;
    return fresh;
  }

  static constexpr std::uint32_t vacant = 0xFFFFFFFFu;

  /// The number of an equal thing entered before; `vacant` where there is none.
  template <class Equal>
  std::uint32_t find(std::uint64_t hash, const Equal& equal) const {
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t slot = hash & (entries_.size() - 1); entries_[slot].number != vacant;
         slot = (slot + 1) & (entries_.size() - 1))
      if (entries_[slot].tag == tag && equal(entries_[slot].number)) return entries_[slot].number;
    return vacant;
  }

 private:
  struct Entry {
    std::uint32_t number = vacant, tag = 0;
    std::uint64_t hash = 0;
  };

  void grow() {
    std::vector<Entry> old(2 * entries_.size());
    old.swap(entries_);
    for (const Entry& entry : old) {
      if (entry.number == vacant) continue;
      std::size_t slot = entry.hash & (entries_.size() - 1);
      while (entries_[slot].number != vacant) slot = (slot + 1) & (entries_.size() - 1);
      entries_[slot] = entry;
    }
  }

  std::vector<Entry> entries_;
  std::size_t count_ = 0;
};

}  // namespace brisance
