#include "frame/gas_file.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include "base/check.h"
#include "frame/frame_samples.h"
#include "scratch_directory.h"

/// The library loses the node it was reading when a stream ends early; only these tests of damage get that far.
extern "C" const char* __lsan_default_suppressions() { return "leak:readTopology\nleak:readBuffers\n"; }

namespace brisance {
namespace {

TEST(GasFile, ReadsBackTheSameGas) {
  const ScratchDirectory scratch;
  const FrameGas gas = sampleGas();
  ASSERT_GT(gas.density.bricks.size(), 4u);
  writeGas(scratch / "gas.vdb", sourceOf(gas));
  EXPECT_EQ(readGas(scratch / "gas.vdb"), gas);
}

TEST(GasFile, EmptyGasIsAFileToo) {
  const ScratchDirectory scratch;
  FrameGas gas;
  gas.temperature.background = 300;
  writeGas(scratch / "gas.vdb", sourceOf(gas));
  EXPECT_EQ(readGas(scratch / "gas.vdb"), gas);
}

TEST(GasFile, BricksFarApartAreTheSameToo) {
  const ScratchDirectory scratch;
  FrameGas gas;
  gas.density.size = {9000, 9000, 9000};
  for (const int z : {0, 120, 128, 4096, 8200})
    for (const int y : {8, 136, 4088, 8192})
      for (const int x : {0, 128, 4224}) gas.density.bricks.push_back({{x, y, z}, {static_cast<float>(1 + x + y + z)}});
  writeGas(scratch / "gas.vdb", sourceOf(gas));
  EXPECT_EQ(readGas(scratch / "gas.vdb"), gas);
}

TEST(GasFile, EqualGasIsEqualBytesAndOtherGasIsNot) {
  const FrameGas gas = sampleGas();
  FrameGas other = gas;
  other.flame.bricks.back().values[5] += 1;
  EXPECT_EQ(gasToVdb(gas), gasToVdb(sampleGas()));
  EXPECT_NE(gasToVdb(gas), gasToVdb(other));
  EXPECT_EQ(contentHash(gas), contentHash(sampleGas()));
  EXPECT_NE(contentHash(gas), contentHash(other));
}

TEST(GasFile, ContentTellsApartGridsAndPlaces) {
  FrameGas gas = sampleGas(), moved = gas, swapped = gas;
  moved.density.origin.x += 1e-12;
  std::swap(swapped.density, swapped.temperature);
  EXPECT_NE(contentHash(gas), contentHash(moved));
  EXPECT_NE(contentHash(gas), contentHash(swapped));
}

/// As any other program opens it.
openvdb::GridBase::Ptr openWithTheLibrary(const std::filesystem::path& path, const std::string& name) {
  openvdb::initialize();
  openvdb::io::File file(path.string());
  file.open(/*delayLoad=*/false);
  return file.readGrid(name);
}

TEST(GasFile, OpensInOtherProgramsWithNamesClassesAndPlaces) {
  const ScratchDirectory scratch;
  const FrameGas gas = sampleGas();
  writeGas(scratch / "gas.vdb", sourceOf(gas));
  for (const char* name : {"density", "temperature", "flame", "vel"}) {
    const auto grid = openWithTheLibrary(scratch / "gas.vdb", name);
    EXPECT_EQ(grid->getName(), name);
    EXPECT_EQ(grid->getGridClass(), openvdb::GRID_FOG_VOLUME);
    EXPECT_GT(grid->activeVoxelCount(), 0u);
    const openvdb::Vec3d place = grid->indexToWorld(openvdb::Coord(3, 4, 5));
    const Vec3d expected = gas.density.origin + Vec3d(3, 4, 5) * gas.density.cellSize;
    EXPECT_NEAR(length(Vec3d(place.x(), place.y(), place.z()) - expected), 0, 1e-15);
  }
}

TEST(GasFile, EachVoxelLiesWhereItsCellIs) {
  const ScratchDirectory scratch;
  writeGas(scratch / "gas.vdb", sourceOf(sampleGas()));
  const auto temperature =
      openvdb::gridPtrCast<openvdb::FloatGrid>(openWithTheLibrary(scratch / "gas.vdb", "temperature"));
  const Grid3<float> dense = ballOfNoise(300);
  EXPECT_EQ(temperature->background(), 300);
  for (int k = -1; k <= dense.size.z; ++k)
    for (int j = -1; j <= dense.size.y; ++j)
      for (int i = -1; i <= dense.size.x; ++i) {
        const openvdb::Coord cell(i, j, k);
        const float expected = dense.contains(i, j, k) ? dense(i, j, k) : 300;
        ASSERT_EQ(temperature->tree().getValue(cell), expected) << i << " " << j << " " << k;
        ASSERT_EQ(temperature->tree().isValueOn(cell), expected != 300);
      }
}

/// A point of the gas at (x, y, z) lies at (x, -z, y) where z is up, and what flew along (x, y, z) flies along the
/// same.
TEST(GasFile, WhereZIsUpTheGasLiesAndFliesTurned) {
  const ScratchDirectory scratch;
  const FrameGas gas = sampleGas();
  writeDurably(scratch / "gas.vdb", gasToVdb(gas, {"velocity", true}));
  const auto grid = openvdb::gridPtrCast<openvdb::Vec3SGrid>(openWithTheLibrary(scratch / "gas.vdb", "velocity"));
  const openvdb::Coord cell(9, 11, 13);
  const Vec3d before = gas.velocity.origin + Vec3d(9, 11, 13) * gas.velocity.cellSize;
  const openvdb::Vec3d place = grid->indexToWorld(cell);
  EXPECT_NEAR(length(Vec3d(place.x(), place.y(), place.z()) - Vec3d(before.x, -before.z, before.y)), 0, 1e-15);
  const float v = ballOfNoise(0)(9, 11, 13);  // sampleGas flies along (v, -2 v, 1 + v)
  ASSERT_NE(v, 0);
  EXPECT_EQ(grid->tree().getValue(cell), openvdb::Vec3s(v, -(1 + v), -2 * v));
  for (const char* name : {"density", "temperature", "flame"}) {
    const auto other = openWithTheLibrary(scratch / "gas.vdb", name);
    EXPECT_EQ(other->transform(), grid->transform()) << name;
    EXPECT_GT(other->transform().baseMap()->determinant(), 0) << "turned, not mirrored";
  }
  const auto temperature =
      openvdb::gridPtrCast<openvdb::FloatGrid>(openWithTheLibrary(scratch / "gas.vdb", "temperature"));
  EXPECT_EQ(temperature->tree().getValue(cell), ballOfNoise(300)(9, 11, 13));
}

TEST(GasFile, OtherConventionsMakeAnotherFile) {
  const FrameGas gas = sampleGas();
  const auto uuid = [](const std::string& bytes) { return bytes.substr(21, 36); };
  EXPECT_EQ(gasToVdb(gas, {}), gasToVdb(gas));
  EXPECT_EQ(gasToVdb(gas, {"velocity", true}), gasToVdb(gas, {"velocity", true}));
  EXPECT_NE(uuid(gasToVdb(gas, {"velocity", true})), uuid(gasToVdb(gas)));
}

TEST(GasFile, HoldsFourGrids) {
  const ScratchDirectory scratch;
  writeGas(scratch / "gas.vdb", sourceOf(sampleGas()));
  openvdb::initialize();
  openvdb::io::File file((scratch / "gas.vdb").string());
  file.open(/*delayLoad=*/false);
  EXPECT_EQ(file.getGrids()->size(), 4u);
}

TEST(GasFile, RefusesWhatIsNoGas) {
  EXPECT_THROW(gasFromVdb("", "a.vdb"), DamagedFile);
  EXPECT_THROW(gasFromVdb("no such thing", "a.vdb"), DamagedFile);
  EXPECT_THROW(readGas("/nonexistent/a.vdb"), DamagedFile);
}

TEST(GasFile, TruncationsAreRefused) {
  const std::string whole = gasToVdb(sampleGas());
  constexpr std::size_t step = 977;  // prime, so that cuts fall on all kinds of fields
  for (std::size_t length = 0; length < whole.size(); length += step)
    ASSERT_THROW(gasFromVdb(whole.substr(0, length), "a.vdb"), DamagedFile) << length;
}

TEST(GasFile, NamesTheFileInOneLine) {
  try {
    gasFromVdb("no such thing", "run/gas/gas.0007.vdb");
    FAIL();
  } catch (const DamagedFile& damaged) {
    EXPECT_EQ(std::string(damaged.what()).find("run/gas/gas.0007.vdb: "), 0u);
    EXPECT_EQ(std::string(damaged.what()).find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace brisance
