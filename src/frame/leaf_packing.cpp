#include "frame/leaf_packing.h"

#include <blosc.h>

#include <algorithm>
#include <bit>
#include <tuple>

#include "base/durable_file.h"
#include "base/parallel.h"

namespace brisance {

namespace {

constexpr int side = brickSide, samples = side * side * side;

/// Our bricks run along i first, leaves along k; the word of a mask is of one i.
template <class T>
void toLeafOrder(const BrickValues<T>& values, BrickValues<T>& leaf) {
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) leaf[(i * side + j) * side + k] = values[(k * side + j) * side + i];
}

/// OpenVDB's tree has children of 4096, 128 and 8 samples a side, in each the ones along z first: as one number.
std::uint64_t treePlace(const Vec3i& corner) {
  std::uint64_t place = 0;
  const auto addBits = [&](int first, int count) {
    for (int axis = 0; axis < 3; ++axis)
      place = place << count | (static_cast<std::uint64_t>(corner[axis]) >> first & ((1u << count) - 1));
  };
  addBits(12, 12);  // grids of up to 2^24 samples a side
  addBits(7, 5);
  addBits(3, 4);
  return place;
}

/// Leaves that follow each other along z in one child of the tree: what is hashed and packed in one go.
struct Column {
  std::size_t first = 0, last = 0;  // in the order
};

/// The bricks in the order of the tree, and the columns of that order.
struct TreeOrder {
  std::vector<std::uint32_t> bricks;
  std::vector<Column> columns;

  explicit TreeOrder(const std::vector<Vec3i>& corners) : bricks(corners.size()) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> places(corners.size());
    for (std::size_t n = 0; n < places.size(); ++n) places[n] = {treePlace(corners[n]), static_cast<std::uint32_t>(n)};
    std::sort(places.begin(), places.end());
    for (std::size_t n = 0; n < places.size(); ++n) bricks[n] = places[n].second;
    const auto columnOf = [&](std::uint32_t n) { return std::tuple(corners[n].x, corners[n].y, corners[n].z >> 7); };
    for (std::size_t n = 0; n < bricks.size(); ++n) {
      if (n == 0 || columnOf(bricks[n]) != columnOf(bricks[n - 1])) columns.push_back({n, n});
      ++columns.back().last;
    }
  }
};

/// A column's leaves.
struct PackedColumn {
  std::vector<Vec3i> corners;
  std::vector<LeafMask> masks;
  RawBytes bytes;
  std::string content;  // hash of corners and values; empty: no leaves
};

using Bytes8 = std::array<std::uint8_t, 64>;

/// Bit n is byte n, each of which is 0 or 1.
std::uint64_t gatherBits(const Bytes8& bytes) {
  constexpr std::uint64_t diagonal = 0x0102040810204080;  // brings bit 0 of byte n to bit 56 + n
  std::uint64_t bits = 0;
  for (int n = 0; n < 64; n += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, &bytes[n], sizeof eight);
    bits |= (eight * diagonal >> 56) << n;
  }
  return bits;
}

/// 0 where two samples are the same to the bit.
template <class T>
std::uint32_t difference(const T& a, const T& b) {
  using Bits = std::array<std::uint32_t, sizeof(T) / sizeof(std::uint32_t)>;
  const auto bits = std::bit_cast<Bits>(a), others = std::bit_cast<Bits>(b);
  std::uint32_t all = 0;
  for (std::size_t part = 0; part < bits.size(); ++part) all |= bits[part] ^ others[part];
  return all;
}

template <class T>
bool isEmpty(const BrickValues<T>& values, const T& background) {
  std::uint32_t all = 0;
  for (int first = 0; first < samples && all == 0; first += 64)
    for (int n = first; n < first + 64; ++n) all |= difference(values[n], background);
  return all == 0;
}

template <class T>
LeafMask activeMask(const BrickValues<T>& leaf, const T& background) {
  LeafMask mask{};
  Bytes8 differs;
  for (int word = 0; word < side; ++word) {
    for (int n = 0; n < 64; ++n) differs[n] = difference(leaf[64 * word + n], background) != 0;
    mask[word] = gatherBits(differs);
  }
  return mask;
}

/// Moves the active samples of a leaf together; how many.
template <class T>
int gatherActive(BrickValues<T>& leaf, const LeafMask& mask) {
  constexpr auto isFull = [](std::uint64_t word) { return ~word == 0; };
  if (std::all_of(mask.begin(), mask.end(), isFull)) return samples;
  int count = 0;
  for (int word = 0; word < side; ++word)
    for (std::uint64_t rest = mask[word]; rest != 0; rest &= rest - 1)
      leaf[count++] = leaf[64 * word + std::countr_zero(rest)];
  return count;
}

template <class T>
char* put(char* to, const T& value) {
  std::memcpy(to, &value, sizeof value);
  return to + sizeof value;
}

/// Its size, negative where the samples are stored as they are; then the samples. Returns the end.
char* putPacked(char* to, const void* values, std::size_t size) {
  constexpr int level = 9;
  char* packed = to + sizeof(std::int64_t);
  const int packedSize =
      blosc_compress_ctx(level, BLOSC_SHUFFLE, sizeof(float), size, values, packed, size, BLOSC_LZ4_COMPNAME, size, 1);
  if (packedSize > 0) {
    put(to, std::int64_t{packedSize});
    return packed + packedSize;
  }
  put(to, -static_cast<std::int64_t>(size));
  std::memcpy(packed, values, size);
  return packed + size;
}

template <class T>
constexpr std::size_t largestLeaf = sizeof(LeafMask) + 1 + sizeof(std::int64_t) + sizeof(BrickValues<T>);

template <class T>
char* putLeaf(char* to, BrickValues<T>& leaf, const LeafMask& mask) {
  constexpr char inactiveAreBackground = 0;
  to = put(put(to, mask), inactiveAreBackground);
  const int count = gatherActive(leaf, mask);
  return putPacked(to, leaf.data(), sizeof(T) * count);
}

/// Calls visit(corner, values, the same in a leaf's order, mask) for each leaf of a column; the hash of them all.
template <class T, class Visit>
std::string visitColumn(const BrickSource<T>& source, const TreeOrder& order, const Column& column,
                        const Visit& visit) {
  BrickValues<T> values, leaf;
  ContentHash hash;
  bool any = false;
  for (std::size_t n = column.first; n < column.last; ++n) {
    const std::uint32_t brick = order.bricks[n];
    source.read(brick, values);
    if (isEmpty(values, source.background)) continue;
    toLeafOrder(values, leaf);
    const LeafMask mask = activeMask(leaf, source.background);
    any = true;
    hash.add(&source.corners[brick], sizeof(Vec3i));
    hash.add(&values, sizeof values);
    visit(source.corners[brick], leaf, mask);
  }
  return any ? hash.hex() : std::string();
}

/// The hash of a grid is that of its place and of the hashes of its columns.
template <class T>
std::string contentOf(const BrickSource<T>& source, const std::vector<PackedColumn>& columns) {
  ContentHash hash;
  const auto addValue = [&](const auto& value) { hash.add(&value, sizeof value); };
  addValue(source.size);
  addValue(source.origin);
  addValue(source.cellSize);
  addValue(source.background);
  for (const PackedColumn& column : columns) hash.add(column.content);
  return hash.hex();
}

/// make(column's number, column) for all of them, several at once.
template <class Make>
std::vector<PackedColumn> forColumns(const TreeOrder& order, const Make& make) {
  std::vector<PackedColumn> columns(order.columns.size());
  constexpr std::int64_t grain = 4;
  parallelFor(0, std::ssize(columns), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t c = first; c < last; ++c) make(order.columns[c], columns[c]);
  });
  return columns;
}

}  // namespace

template <class T>
PackedLeaves packLeaves(const BrickSource<T>& source) {
  blosc_set_splitmode(BLOSC_NEVER_SPLIT);  // a leaf's bytes in one stream: a twelfth of the calls
  const TreeOrder order(source.corners);
  std::vector<PackedColumn> columns = forColumns(order, [&](const Column& column, PackedColumn& packed) {
    packed.bytes.resize((column.last - column.first) * largestLeaf<T>);
    char* end = packed.bytes.data();
    packed.content =
        visitColumn(source, order, column, [&](const Vec3i& corner, BrickValues<T>& leaf, const LeafMask& mask) {
          packed.corners.push_back(corner);
          packed.masks.push_back(mask);
          end = putLeaf(end, leaf, mask);
        });
    packed.bytes.resize(end - packed.bytes.data());
    packed.bytes.shrink_to_fit();
  });
  PackedLeaves leaves;
  leaves.content = contentOf(source, columns);
  for (PackedColumn& column : columns) {
    if (column.corners.empty()) continue;
    leaves.corners.insert(leaves.corners.end(), column.corners.begin(), column.corners.end());
    leaves.masks.insert(leaves.masks.end(), column.masks.begin(), column.masks.end());
    leaves.pieces.push_back(std::move(column.bytes));
  }
  return leaves;
}

template <class T>
std::string contentHash(const BrickSource<T>& source) {
  const TreeOrder order(source.corners);
  return contentOf(source, forColumns(order, [&](const Column& column, PackedColumn& packed) {
                     packed.content = visitColumn(source, order, column, [](const Vec3i&, auto&, const LeafMask&) {});
                   }));
}

template PackedLeaves packLeaves(const BrickSource<float>&);
template PackedLeaves packLeaves(const BrickSource<Vec3f>&);
template std::string contentHash(const BrickSource<float>&);
template std::string contentHash(const BrickSource<Vec3f>&);

}  // namespace brisance
