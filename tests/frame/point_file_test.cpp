// Particles as OpenVDB points, read back with the library.
#include "frame/point_file.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointCount.h>
#include <openvdb/points/PointDataGrid.h>

#include <map>

#include "base/durable_file.h"
#include "base/parallel.h"
#include "frame/frame_samples.h"
#include "scratch_directory.h"

namespace brisance {
namespace {

namespace points = openvdb::points;

const PointFileSettings settings{{0.25, -1, 3}, 0.125, {0.1f, 0.2f, 0.3f, 0.4f, 0.5f}};

points::PointDataGrid::Ptr opened(const std::string& bytes) {
  const ScratchDirectory scratch;
  writeDurably(scratch / "particles.0001.vdb", bytes);
  openvdb::initialize();
  openvdb::io::File file((scratch / "particles.0001.vdb").string());
  file.open(/*delayLoad=*/false);
  return openvdb::gridPtrCast<points::PointDataGrid>(file.readGrid("particles"));
}

/// What belongs to one particle, found again by its temperature, which no two of them share.
struct ReadParticle {
  openvdb::Vec3d position;
  openvdb::Vec3f velocity;
  float mass, radius;
  std::int32_t kind;
};

std::map<float, ReadParticle> readBack(const points::PointDataGrid& grid) {
  std::map<float, ReadParticle> read;
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    const points::AttributeHandle<openvdb::Vec3f> place(leaf->constAttributeArray("P")),
        v(leaf->constAttributeArray("v"));
    const points::AttributeHandle<float> temperature(leaf->constAttributeArray("temperature")),
        mass(leaf->constAttributeArray("mass")), radius(leaf->constAttributeArray("pscale"));
    const points::AttributeHandle<std::int32_t> kind(leaf->constAttributeArray("kind"));
    for (auto point = leaf->beginIndexOn(); point; ++point) {
      const openvdb::Vec3d cell = point.getCoord().asVec3d();
      read[temperature.get(*point)] = {grid.indexToWorld(cell + openvdb::Vec3d(place.get(*point))), v.get(*point),
                                       mass.get(*point), radius.get(*point), kind.get(*point)};
    }
  }
  return read;
}

TEST(PointFile, HoldsEveryParticleWithAllThatIsKnownOfIt) {
  FrameParticles particles = sampleParticles(2000);
  for (std::size_t n = 0; n < particles.kind.size(); ++n) {
    particles.kind[n] = static_cast<std::uint8_t>(n % 5);
    particles.temperature[n] = 300 + static_cast<float>(n);
  }
  const auto grid = opened(particlesToVdb(particles, settings));
  ASSERT_TRUE(grid);
  EXPECT_EQ(points::pointCount(grid->tree()), 2000u);
  const auto read = readBack(*grid);
  ASSERT_EQ(read.size(), 2000u);
  for (std::size_t n = 0; n < 2000; ++n) {
    const ReadParticle& one = read.at(particles.temperature[n]);
    for (int axis = 0; axis < 3; ++axis) {
      // Half a unit in the last place of a number up to 1/2, in voxels.
      EXPECT_NEAR(one.position[axis], particles.position[n][axis], settings.voxelSize * 0x1p-25);
      EXPECT_EQ(one.velocity[axis], particles.velocity[n][axis]);
    }
    EXPECT_EQ(one.mass, particles.mass[n]);
    EXPECT_EQ(one.kind, particles.kind[n]);
    EXPECT_EQ(one.radius, settings.radius[particles.kind[n]]);
  }
}

TEST(PointFile, ItsVoxelsLieAsTheSettingsSay) {
  const auto grid = opened(particlesToVdb(sampleParticles(10), settings));
  EXPECT_EQ(grid->indexToWorld(openvdb::Coord(0, 0, 0)), openvdb::Vec3d(0.25, -1, 3));
  EXPECT_EQ(grid->voxelSize(), openvdb::Vec3d(0.125, 0.125, 0.125));
}

TEST(PointFile, NoParticlesAreAFileToo) {
  const auto grid = opened(particlesToVdb({}, settings));
  ASSERT_TRUE(grid);
  EXPECT_EQ(points::pointCount(grid->tree()), 0u);
}

TEST(PointFile, EqualParticlesAreEqualBytesForAnyNumberOfThreads) {
  const FrameParticles particles = sampleParticles(100000);
  const std::string bytes = particlesToVdb(particles, settings);
  const ThreadLimit one(1);
  EXPECT_EQ(bytes, particlesToVdb(particles, settings));
  EXPECT_NE(bytes, particlesToVdb(sampleParticles(99999), settings));
}

}  // namespace
}  // namespace brisance
