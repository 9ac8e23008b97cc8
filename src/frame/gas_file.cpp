#include "frame/gas_file.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <sstream>
#include <tuple>
#include <vector>

#include "base/check.h"
#include "base/parallel.h"
#include "frame/leaf_packing.h"
#include "frame/vdb_uuid.h"

namespace brisance {

namespace {

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

/// y up becomes z up: (x, y, z) goes to (x, -z, y). Points are rows there.
openvdb::Mat4R yUpToZUp() { return {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1}; }

BrickSource<Vec3f> turnedToZUp(const BrickSource<Vec3f>& grid) {
  const auto turn = [](Vec3f& v) { v = {v.x, -v.z, v.y}; };
  BrickSource<Vec3f> turned = grid;
  turn(turned.background);
  turned.read = [&grid, turn](std::size_t n, BrickValues<Vec3f>& values) {
    grid.read(n, values);
    std::for_each(values.begin(), values.end(), turn);
  };
  return turned;
}

/// A grid with leaves that have masks but no samples.
template <class VdbGrid, class T>
typename VdbGrid::Ptr makeSkeleton(const BrickSource<T>& source, const PackedLeaves& leaves) {
  using Leaf = typename VdbGrid::TreeType::LeafNodeType;
  const auto background = toVdb(source.background);
  auto grid = VdbGrid::create(background);
  for (std::size_t n = 0; n < leaves.corners.size(); ++n) {
    const Vec3i& corner = leaves.corners[n];
    auto leaf =
        std::make_unique<Leaf>(openvdb::PartialCreate(), openvdb::Coord(corner.x, corner.y, corner.z), background);
    typename Leaf::NodeMaskType active;
    for (int word = 0; word < brickSide; ++word) active.template getWord<std::uint64_t>(word) = leaves.masks[n][word];
    leaf->setValueMask(active);
    grid->tree().addLeaf(leaf.release());
  }
  auto next = leaves.corners.begin();
  for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf, ++next)
    CHECK(leaf->origin() == openvdb::Coord(next->x, next->y, next->z), "the tree has another order");
  return grid;
}

template <class T>
void describe(openvdb::GridBase& vdb, const BrickSource<T>& grid, const std::string& name, bool zUp) {
  auto transform = openvdb::math::Transform::createLinearTransform(grid.cellSize);
  transform->postTranslate({grid.origin.x, grid.origin.y, grid.origin.z});
  if (zUp) transform->postMult(yUpToZUp());
  vdb.setTransform(transform);
  vdb.setName(name);
  vdb.setGridClass(openvdb::GRID_FOG_VOLUME);
  vdb.insertMeta(sizeKey, openvdb::Vec3IMetadata({grid.size.x, grid.size.y, grid.size.z}));
  vdb.addStatsMetadata();
}

template <class T>
void writeValue(std::ostream& out, T value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

/// What stands before a grid's leaves: all that the library writes itself.
struct GridHead {
  std::string bytes;
  openvdb::io::GridDescriptor descriptor;
  std::size_t offsets = 0;   ///< where in the bytes the descriptor's three offsets lie,
  std::size_t contents = 0;  ///< and what they count: the grid's start
};

GridHead writeHead(const openvdb::GridBase& grid) {
  constexpr std::uint32_t compression = openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK;
  GridHead head{{}, {grid.getName(), grid.type()}};
  std::ostringstream out(std::ios_base::binary);
  openvdb::io::setDataCompression(out, compression);
  head.descriptor.writeHeader(out);
  head.offsets = static_cast<std::size_t>(out.tellp());
  head.descriptor.writeStreamPos(out);
  head.contents = static_cast<std::size_t>(out.tellp());
  writeValue(out, compression);
  grid.writeMeta(out);
  grid.writeTransform(out);
  grid.writeTopology(out);
  head.bytes = std::move(out).str();
  return head;
}

/// A grid of the file: the head, then the leaves.
struct PackedGrid {
  GridHead head;
  std::vector<RawBytes> leaves;
  std::string content;
};

template <class VdbGrid, class T>
PackedGrid packGrid(const BrickSource<T>& source, const std::string& name, bool zUp) {
  PackedLeaves leaves = packLeaves(source);
  const auto vdb = makeSkeleton<VdbGrid>(source, leaves);
  describe(*vdb, source, name, zUp);
  return {writeHead(*vdb), std::move(leaves.pieces), std::move(leaves.content)};
}

PackedGrid packVelocity(const BrickSource<Vec3f>& source, const GasConventions& conventions) {
  const std::string& name = conventions.velocityName;
  if (conventions.zUp) return packGrid<openvdb::Vec3SGrid>(turnedToZUp(source), name, true);
  return packGrid<openvdb::Vec3SGrid>(source, name, false);
}

/// Fills in the offsets of a grid that begins at `place` of the file; returns where it ends.
std::int64_t placeAt(PackedGrid& grid, std::int64_t place) {
  GridHead& head = grid.head;
  std::int64_t end = place + std::ssize(head.bytes);
  head.descriptor.setGridPos(place + static_cast<std::int64_t>(head.contents));
  head.descriptor.setBlockPos(end);
  for (const RawBytes& leaves : grid.leaves) end += std::ssize(leaves);
  head.descriptor.setEndPos(end);
  std::ostringstream offsets(std::ios_base::binary);
  head.descriptor.writeStreamPos(offsets);
  head.bytes.replace(head.offsets, offsets.str().size(), offsets.str());
  return end;
}

/// A file's beginning. The library writes a random UUID, behind magic number, versions and a flag; ours is the hash.
class FileStart : public openvdb::io::Archive {
 public:
  std::string bytes(const std::string& hash, std::int32_t grids) const {
    std::ostringstream out(std::ios_base::binary);
    writeHeader(out, /*seekable=*/true);
    openvdb::MetaMap().writeMeta(out);
    writeValue(out, grids);
    return withUuid(std::move(out).str(), hash);
  }
};

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

GasSource sourceOf(const FrameGas& gas) {
  return {bricksOf(gas.density), bricksOf(gas.temperature), bricksOf(gas.flame), bricksOf(gas.velocity)};
}

namespace {
/// Of what the grids mean, in our names and order.
std::string contentOf(const std::array<std::string, 4>& grids) {
  ContentHash hash;
  for (const std::string& grid : grids) hash.add(grid);
  return hash.hex();
}

/// What the UUID is made of: the content and, where they are not ours, the conventions.
std::string nameOf(const std::string& content, const GasConventions& conventions) {
  if (conventions == GasConventions{}) return content;
  ContentHash hash;
  hash.add(fmt::format("{} {} {}", content, conventions.velocityName, conventions.zUp));
  return hash.hex();
}
}  // namespace

std::string contentHash(const FrameGas& gas) {
  const GasSource source = sourceOf(gas);
  return contentOf({contentHash(source.density), contentHash(source.temperature), contentHash(source.flame),
                    contentHash(source.velocity)});
}

namespace {
/// Nested loops: where one grid has little for several threads, they find others.
std::array<PackedGrid, 4> packGrids(const GasSource& gas, const GasConventions& conventions) {
  const bool zUp = conventions.zUp;
  std::array<PackedGrid, 4> grids;
  parallelFor(0, std::ssize(grids), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) {
      if (n == 0) grids[0] = packGrid<openvdb::FloatGrid>(gas.density, "density", zUp);
      if (n == 1) grids[1] = packGrid<openvdb::FloatGrid>(gas.temperature, "temperature", zUp);
      if (n == 2) grids[2] = packGrid<openvdb::FloatGrid>(gas.flame, "flame", zUp);
      if (n == 3) grids[3] = packVelocity(gas.velocity, conventions);
    }
  });
  return grids;
}
}  // namespace

PackedGas packGas(const GasSource& gas, const GasConventions& conventions) {
  openvdb::initialize();
  std::array<PackedGrid, 4> grids = packGrids(gas, conventions);
  PackedGas packed{{}, contentOf({grids[0].content, grids[1].content, grids[2].content, grids[3].content})};
  const auto add = [&](const std::string& bytes) { packed.pieces.emplace_back(bytes.begin(), bytes.end()); };
  add(FileStart().bytes(nameOf(packed.content, conventions), std::ssize(grids)));
  std::int64_t end = std::ssize(packed.pieces[0]);
  for (PackedGrid& grid : grids) {
    end = placeAt(grid, end);
    add(grid.head.bytes);
    std::move(grid.leaves.begin(), grid.leaves.end(), std::back_inserter(packed.pieces));
  }
  return packed;
}

void PackedGas::writeTo(std::ostream& out) const {
  for (const RawBytes& piece : pieces) out.write(piece.data(), std::ssize(piece));
}

std::string gasToVdb(const FrameGas& gas, const GasConventions& conventions) {
  const PackedGas packed = packGas(sourceOf(gas), conventions);
  std::string bytes;
  std::size_t size = 0;
  for (const RawBytes& piece : packed.pieces) size += piece.size();
  bytes.reserve(size);
  for (const RawBytes& piece : packed.pieces) bytes.append(piece.data(), piece.size());
  return bytes;
}

FileRecord writeGas(const std::filesystem::path& path, const GasSource& gas) {
  const PackedGas packed = packGas(gas);
  return writeDurably(path, [&](std::ostream& out) { packed.writeTo(out); });
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
