#include "frame/leaf_packing.h"

#include <blosc.h>

#include <cstring>

#include "base/check.h"
#include "base/parallel.h"

namespace brisance {

namespace {

constexpr int side = 8, samples = side * side * side;
constexpr std::int64_t piece = 64;  // leaves

template <class T>
bool sameBits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Our bricks run along i first, leaves along k; the word of a mask is of one i.
constexpr int leafPlace(int n) {
  const int i = n % side, j = n / side % side, k = n / (side * side);
  return (i * side + j) * side + k;
}

template <class T>
LeafMask activeMask(const std::array<T, samples>& values, const T& background) {
  LeafMask mask{};
  for (int n = 0; n < samples; ++n) {
    const int place = leafPlace(n);
    mask[place / 64] |= static_cast<std::uint64_t>(!sameBits(values[n], background)) << (place % 64);
  }
  return mask;
}

/// The active samples in the leaf's order; how many.
template <class T>
int gatherActive(const std::array<T, samples>& values, const LeafMask& mask, T* active) {
  int count = 0;
  for (int place = 0; place < samples; ++place) {
    active[count] = values[leafPlace(place)];  // the way back is the same
    count += static_cast<int>(mask[place / 64] >> (place % 64) & 1);
  }
  return count;
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Its size, negative where the samples are stored as they are; then the samples.
void appendPacked(std::string& bytes, const void* values, std::size_t valueSize, int count) {
  constexpr int level = 9;
  const std::size_t size = valueSize * count;
  char packed[sizeof(Vec3f) * samples + BLOSC_MAX_OVERHEAD];
  const int packedSize = size == 0 ? 0
                                   : blosc_compress_ctx(level, BLOSC_SHUFFLE, valueSize, size, values, packed, size,
                                                        BLOSC_LZ4_COMPNAME, size, 1);
  append(bytes, packedSize > 0 ? std::int64_t{packedSize} : -static_cast<std::int64_t>(size));
  packedSize > 0 ? bytes.append(packed, packedSize) : bytes.append(static_cast<const char*>(values), size);
}

template <class T>
void appendLeaf(std::string& bytes, const std::array<T, samples>& values, const LeafMask& mask) {
  constexpr char inactiveAreBackground = 0;
  T active[samples + 1];
  const int count = gatherActive(values, mask, active);
  append(bytes, mask);
  append(bytes, inactiveAreBackground);
  appendPacked(bytes, active, sizeof(T), count);
}

}  // namespace

template <class T>
std::vector<LeafMask> activeMasks(const SparseGrid<T>& grid) {
  std::vector<LeafMask> masks(grid.bricks.size());
  parallelFor(0, std::ssize(masks), piece, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) masks[n] = activeMask(grid.bricks[n].values, grid.background);
  });
  return masks;
}

template <class T>
std::vector<std::string> packLeaves(const SparseGrid<T>& grid, const std::vector<LeafMask>& masks,
                                    std::span<const std::uint32_t> order) {
  const std::int64_t count = std::ssize(order);
  std::vector<std::string> pieces((count + piece - 1) / piece);
  parallelFor(0, std::ssize(pieces), 1, [&](std::int64_t first, std::int64_t last) {
    std::string bytes;
    for (std::int64_t p = first; p < last; ++p) {
      bytes.clear();
      for (std::int64_t n = p * piece; n < std::min(count, (p + 1) * piece); ++n)
        appendLeaf(bytes, grid.bricks[order[n]].values, masks[order[n]]);
      pieces[p] = bytes;
    }
  });
  return pieces;
}

template std::vector<LeafMask> activeMasks(const SparseGrid<float>&);
template std::vector<LeafMask> activeMasks(const SparseGrid<Vec3f>&);
template std::vector<std::string> packLeaves(const SparseGrid<float>&, const std::vector<LeafMask>&,
                                             std::span<const std::uint32_t>);
template std::vector<std::string> packLeaves(const SparseGrid<Vec3f>&, const std::vector<LeafMask>&,
                                             std::span<const std::uint32_t>);

}  // namespace brisance
