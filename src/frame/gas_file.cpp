#include "frame/gas_file.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <span>
#include <sstream>
#include <tuple>
#include <vector>

#include "base/check.h"
#include "base/parallel.h"

namespace brisance {

namespace {

constexpr int brickSide = 8;  // of our bricks and of OpenVDB's leaves alike
constexpr char sizeKey[] = "brisance_size";

openvdb::Vec3s toVdb(const Vec3f& v) { return {v.x, v.y, v.z}; }
float toVdb(float value) { return value; }
Vec3f fromVdb(const openvdb::Vec3s& v) { return {v.x(), v.y(), v.z()}; }
float fromVdb(float value) { return value; }

/// Our bricks run along i first, the library's leaves along k.
constexpr int leafOffset(int n) {
  const int i = n % brickSide, j = n / brickSide % brickSide, k = n / (brickSide * brickSide);
  return (i * brickSide + j) * brickSide + k;
}

/// Inactive values are kept by the file only as the background, so whatever differs by a single bit is active.
template <class T>
bool sameBits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Straight into the leaf's memory and its mask, one word of which covers the samples of one i.
template <class Leaf, class T>
std::unique_ptr<Leaf> makeLeaf(const typename SparseGrid<T>::Brick& brick, const T& background) {
  auto leaf = std::make_unique<Leaf>(openvdb::Coord(brick.corner.x, brick.corner.y, brick.corner.z), toVdb(background));
  auto* values = leaf->buffer().data();
  typename Leaf::NodeMaskType active;
  for (int i = 0; i < brickSide; ++i) {
    std::uint64_t word = 0;
    for (int bit = 0; bit < brickSide * brickSide; ++bit) {
      const int j = bit / brickSide, k = bit % brickSide;
      const T& value = brick.values[i + brickSide * (j + brickSide * k)];
      values[brickSide * brickSide * i + bit] = toVdb(value);
      word |= static_cast<std::uint64_t>(!sameBits(value, background)) << bit;
    }
    active.template getWord<std::uint64_t>(i) = word;
  }
  leaf->setValueMask(active);
  return leaf;
}

template <class Leaf, class T>
std::vector<std::unique_ptr<Leaf>> makeLeaves(const SparseGrid<T>& grid) {
  std::vector<std::unique_ptr<Leaf>> leaves(grid.bricks.size());
  constexpr std::int64_t grain = 64;
  parallelFor(0, static_cast<std::int64_t>(leaves.size()), grain, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) leaves[n] = makeLeaf<Leaf>(grid.bricks[n], grid.background);
  });
  return leaves;
}

/// y up becomes z up: (x, y, z) goes to (x, -z, y). Points are rows there.
openvdb::Mat4R yUpToZUp() { return {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1}; }

SparseGrid<Vec3f> turnedToZUp(SparseGrid<Vec3f> grid) {
  const auto turn = [](Vec3f& v) { v = {v.x, -v.z, v.y}; };
  turn(grid.background);
  for (auto& brick : grid.bricks) std::for_each(brick.values.begin(), brick.values.end(), turn);
  return grid;
}

template <class VdbGrid, class T>
typename VdbGrid::Ptr makeVdbGrid(const SparseGrid<T>& grid, const std::string& name, bool zUp) {
  auto vdb = VdbGrid::create(toVdb(grid.background));
  for (auto& leaf : makeLeaves<typename VdbGrid::TreeType::LeafNodeType>(grid)) vdb->tree().addLeaf(leaf.release());
  auto transform = openvdb::math::Transform::createLinearTransform(grid.cellSize);
  transform->postTranslate({grid.origin.x, grid.origin.y, grid.origin.z});
  if (zUp) transform->postMult(yUpToZUp());
  vdb->setTransform(transform);
  vdb->setName(name);
  vdb->setGridClass(openvdb::GRID_FOG_VOLUME);
  vdb->insertMeta(sizeKey, openvdb::Vec3IMetadata({grid.size.x, grid.size.y, grid.size.z}));
  return vdb;
}

/// Writes with the grids' offsets, so that readers may pick one grid; the library offers that for files on disk alone,
/// and its own file stream takes a full disk for success.
class MemoryArchive : public openvdb::io::Archive {
 public:
  void writeTo(std::ostream& out, const openvdb::GridCPtrVec& grids) const {
    openvdb::io::Archive::write(out, grids, /*seekable=*/true);
  }
};

/// Bytes of a file of one grid.
template <class VdbGrid, class T>
std::string fileOfOne(const SparseGrid<T>& grid, const std::string& name, bool zUp) {
  std::string room;
  room.reserve(grid.bricks.size() * sizeof(grid.bricks[0]) + (1 << 16));  // so that it need not grow
  std::ostringstream out(std::move(room), std::ios_base::binary | std::ios_base::out);
  MemoryArchive archive;
  archive.setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
  archive.writeTo(out, {makeVdbGrid<VdbGrid>(grid, name, zUp)});
  return std::move(out).str();
}

std::string fileOfVelocity(const SparseGrid<Vec3f>& grid, const GasConventions& conventions) {
  const std::string& name = conventions.velocityName;
  if (conventions.zUp) return fileOfOne<openvdb::Vec3SGrid>(turnedToZUp(grid), name, true);
  return fileOfOne<openvdb::Vec3SGrid>(grid, name, false);
}

/// A file's beginning: magic number, versions, the flag that grids have offsets, the UUID; then what the file itself
/// says (nothing) and the number of grids.
struct FileStart {
  static constexpr std::size_t uuid = sizeof(std::int64_t) + 3 * sizeof(std::uint32_t) + sizeof(char);
  static constexpr std::size_t metadata = uuid + 36;
  static constexpr std::size_t gridCount = metadata + sizeof(std::int32_t);
  static constexpr std::size_t grids = gridCount + sizeof(std::int32_t);
};

template <class T>
T readAt(const std::string& bytes, std::size_t place) {
  CHECK(place + sizeof(T) <= bytes.size(), "a VDB of {} bytes ends before {}", bytes.size(), place);
  T value;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}
template <class T>
void writeAt(std::string& bytes, std::size_t place, T value) {
  std::memcpy(bytes.data() + place, &value, sizeof value);
}

/// Where a grid's three offsets lie: behind its name, its type and its parent's name, each after its length.
std::size_t offsetsOf(const std::string& bytes, std::size_t grid) {
  constexpr int names = 3;
  for (int n = 0; n < names; ++n) grid += sizeof(std::int32_t) + readAt<std::uint32_t>(bytes, grid);
  return grid;
}

/// Appends the grid of a file of one; its offsets count from the start of the whole file.
void appendGrid(std::string& whole, const std::string& one) {
  CHECK(readAt<std::int32_t>(one, FileStart::metadata) == 0 && readAt<std::int32_t>(one, FileStart::gridCount) == 1,
        "the library begins its files otherwise");
  const std::size_t offsets = offsetsOf(one, FileStart::grids);
  const auto moved = static_cast<std::int64_t>(whole.size()) - static_cast<std::int64_t>(FileStart::grids);
  whole.append(one, FileStart::grids);
  for (int n = 0; n < 3; ++n) {
    const std::size_t place = offsets + n * sizeof(std::int64_t);
    const auto offset = readAt<std::int64_t>(one, place);
    CHECK(offset > 0 && offset <= static_cast<std::int64_t>(one.size()), "offset {} of a grid", offset);
    writeAt(whole, place + static_cast<std::size_t>(moved), offset + moved);
  }
}

/// A file of all the grids, in their order; takes the files' memory.
std::string joinGrids(std::span<std::string> files) {
  std::size_t size = 0;
  for (const std::string& file : files) size += file.size();
  std::string whole;
  whole.reserve(size);
  whole.append(files[0], 0, FileStart::grids);
  writeAt(whole, FileStart::gridCount, static_cast<std::int32_t>(files.size()));
  for (std::string& file : files) {
    appendGrid(whole, file);
    file = {};
  }
  return whole;
}

/// The library writes a random UUID.
void replaceUuid(std::string& vdb, const std::string& hash) {
  constexpr std::size_t dashes[] = {8, 13, 18, 23};
  std::string uuid = hash;
  for (const std::size_t dash : dashes) {
    CHECK(vdb.size() > FileStart::uuid + dash && vdb[FileStart::uuid + dash] == '-',
          "no UUID in the header of the VDB");
    uuid.insert(dash, "-");
  }
  vdb.replace(FileStart::uuid, uuid.size(), uuid);
}

template <class T>
void addGrid(ContentHash& hash, const SparseGrid<T>& grid, std::string_view name) {
  const auto addValue = [&](const auto& value) { hash.add(&value, sizeof value); };
  hash.add(name);
  addValue(grid.size);
  addValue(grid.origin);
  addValue(grid.cellSize);
  addValue(grid.background);
  for (const auto& brick : grid.bricks) {
    addValue(brick.corner);
    addValue(brick.values);
  }
}

/// What a grid promises beside its values; thrown as DamagedFile by the caller.
struct BadGrid {
  std::string what;
};

template <class T>
void addBrick(SparseGrid<T>& grid, const Vec3i& corner, const auto& leaf) {
  for (int axis = 0; axis < 3; ++axis)
    if (corner[axis] < 0 || corner[axis] >= grid.size[axis]) throw BadGrid{"has values outside its size"};
  typename SparseGrid<T>::Brick brick{corner, {}};
  for (int n = 0; n < static_cast<int>(brick.values.size()); ++n)
    brick.values[n] = fromVdb(leaf.getValue(leafOffset(n)));
  grid.bricks.push_back(brick);
}

template <class T>
void sortBricks(SparseGrid<T>& grid) {
  const auto place = [](const auto& brick) { return std::tuple(brick.corner.z, brick.corner.y, brick.corner.x); };
  std::sort(grid.bricks.begin(), grid.bricks.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
}

template <class VdbGrid, class T>
void fromVdbGrid(const openvdb::GridBase::ConstPtr& base, SparseGrid<T>& grid) {
  const auto vdb = openvdb::gridConstPtrCast<VdbGrid>(base);
  if (!vdb) throw BadGrid{"is missing or of another type"};
  const auto size = vdb->template getMetadata<openvdb::Vec3IMetadata>(sizeKey);
  if (!size) throw BadGrid{"was not written by this program"};
  grid.size = {size->value().x(), size->value().y(), size->value().z()};
  const openvdb::Vec3d origin = vdb->indexToWorld(openvdb::Coord(0, 0, 0));
  grid.origin = {origin.x(), origin.y(), origin.z()};
  grid.cellSize = vdb->voxelSize().x();
  grid.background = fromVdb(vdb->background());
  if (!isFinite(grid.origin) || !(grid.cellSize > 0)) throw BadGrid{"has no place"};
  if (vdb->tree().activeTileCount() > 0) throw BadGrid{"was not written by this program"};
  for (auto leaf = vdb->tree().cbeginLeaf(); leaf; ++leaf)
    addBrick(grid, {leaf->origin().x(), leaf->origin().y(), leaf->origin().z()}, *leaf);
  sortBricks(grid);
}

template <class VdbGrid, class T>
void readGrid(const openvdb::GridPtrVec& grids, const std::string& name, SparseGrid<T>& grid) {
  const auto found = std::find_if(grids.begin(), grids.end(), [&](const auto& g) { return g && g->getName() == name; });
  try {
    fromVdbGrid<VdbGrid>(found == grids.end() ? nullptr : *found, grid);
  } catch (const BadGrid& bad) {
    throw BadGrid{fmt::format("grid '{}' {}", name, bad.what)};
  }
}

FrameGas readGrids(const std::string& bytes) {
  openvdb::initialize();
  std::istringstream in(bytes, std::ios_base::binary);
  in.exceptions(std::ios_base::eofbit | std::ios_base::failbit | std::ios_base::badbit);  // the library does not look
  const auto grids = openvdb::io::Stream(in, /*delayLoad=*/false).getGrids();
  if (!grids) throw BadGrid{"holds no grids"};
  FrameGas gas;
  readGrid<openvdb::FloatGrid>(*grids, "density", gas.density);
  readGrid<openvdb::FloatGrid>(*grids, "temperature", gas.temperature);
  readGrid<openvdb::FloatGrid>(*grids, "flame", gas.flame);
  readGrid<openvdb::Vec3SGrid>(*grids, "vel", gas.velocity);
  return gas;
}

}  // namespace

std::string contentHash(const FrameGas& gas) {
  ContentHash hash;
  addGrid(hash, gas.density, "density");
  addGrid(hash, gas.temperature, "temperature");
  addGrid(hash, gas.flame, "flame");
  addGrid(hash, gas.velocity, "vel");
  return hash.hex();
}

namespace {
/// What the UUID is made of: the content and, where they are not ours, the conventions.
std::string nameOf(const FrameGas& gas, const GasConventions& conventions) {
  const std::string content = contentHash(gas);
  if (conventions == GasConventions{}) return content;
  ContentHash hash;
  hash.add(fmt::format("{} {} {}", content, conventions.velocityName, conventions.zUp));
  return hash.hex();
}
}  // namespace

std::string gasToVdb(const FrameGas& gas, const GasConventions& conventions) {
  openvdb::initialize();
  const bool zUp = conventions.zUp;
  std::array<std::string, 4> files;
  std::string hash;
  // Compressing takes most of the time, and the velocity is half of the work: it starts first.
  const std::function<void()> work[] = {
      [&] { files[3] = fileOfVelocity(gas.velocity, conventions); },
      [&] { files[0] = fileOfOne<openvdb::FloatGrid>(gas.density, "density", zUp); },
      [&] { files[1] = fileOfOne<openvdb::FloatGrid>(gas.temperature, "temperature", zUp); },
      [&] { files[2] = fileOfOne<openvdb::FloatGrid>(gas.flame, "flame", zUp); },
      [&] { hash = nameOf(gas, conventions); },
  };
  parallelFor(0, std::ssize(work), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) work[n]();
  });
  std::string bytes = joinGrids(files);
  replaceUuid(bytes, hash);
  return bytes;
}

FileRecord writeGas(const std::filesystem::path& path, const FrameGas& gas) {
  return writeDurably(path, gasToVdb(gas));
}

FrameGas gasFromVdb(const std::string& bytes, const std::string& fileName) {
  try {
    return readGrids(bytes);
  } catch (const BadGrid& bad) {
    throw DamagedFile(fmt::format("{}: {}; simulate this frame again", fileName, bad.what));
  } catch (const std::exception& error) {
    throw DamagedFile(
        fmt::format("{}: is no readable VDB file ({}); simulate this frame again", fileName, error.what()));
  }
}

FrameGas readGas(const std::filesystem::path& path) { return gasFromVdb(readFile(path), path.string()); }

}  // namespace brisance
