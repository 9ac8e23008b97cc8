#include "frame/point_file.h"

#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointConversion.h>

#include <span>
#include <sstream>

#include "base/durable_file.h"
#include "frame/particle_file.h"
#include "frame/vdb_uuid.h"

namespace brisance {

namespace {

namespace points = openvdb::points;

/// The list of places as the library reads it.
struct Places {
  using PosType = openvdb::Vec3d;
  using value_type = openvdb::Vec3d;
  const std::vector<Vec3f>& position;
  std::size_t size() const { return position.size(); }
  void getPos(std::size_t n, openvdb::Vec3d& place) const { place = {position[n].x, position[n].y, position[n].z}; }
};

/// One value for each particle as the library reads it.
template <class Value, class Read>
struct Column {
  using value_type = Value;
  Read read;
  void get(Value& value, std::size_t n, openvdb::Index /*of several for each*/ = 0) const { value = read(n); }
};

class PointGrid {
 public:
  PointGrid(const FrameParticles& particles, const PointFileSettings& settings) {
    const auto transform = openvdb::math::Transform::createLinearTransform(settings.voxelSize);
    transform->postTranslate({settings.origin.x, settings.origin.y, settings.origin.z});
    const Places places{particles.position};
    index_ = openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(places, *transform);
    grid_ = points::createPointDataGrid<points::NullCodec, points::PointDataGrid>(*index_, places, *transform);
    grid_->setName("particles");
  }

  template <class Value, class Read>
  void add(const std::string& name, Read read) {
    points::appendAttribute<Value>(grid_->tree(), name);
    points::populateAttribute(grid_->tree(), index_->tree(), name, Column<Value, Read>{read});
  }

  openvdb::GridBase::Ptr finish() {
    points::compactAttributes(grid_->tree());
    return grid_;
  }

 private:
  openvdb::tools::PointIndexGrid::Ptr index_;
  points::PointDataGrid::Ptr grid_;
};

openvdb::GridBase::Ptr gridOf(const FrameParticles& particles, const PointFileSettings& settings) {
  PointGrid grid(particles, settings);
  grid.add<openvdb::Vec3f>("v", [&](std::size_t n) {
    const Vec3f& v = particles.velocity[n];
    return openvdb::Vec3f(v.x, v.y, v.z);
  });
  grid.add<float>("temperature", [&](std::size_t n) { return particles.temperature[n]; });
  grid.add<float>("mass", [&](std::size_t n) { return particles.mass[n]; });
  grid.add<float>("pscale", [&](std::size_t n) { return settings.radius[particles.kind[n]]; });
  grid.add<std::int32_t>("kind", [&](std::size_t n) { return std::int32_t{particles.kind[n]}; });
  return grid.finish();
}

/// Writes with the place of each grid in the file, as the library's own files have it.
class SeekableFile : public openvdb::io::Archive {
 public:
  std::string bytes(const openvdb::GridBase::Ptr& grid) const {
    std::ostringstream out(std::ios_base::binary);
    write(out, openvdb::GridCPtrVec{grid}, /*seekable=*/true);
    return std::move(out).str();
  }
};

std::string nameOf(const FrameParticles& particles, const PointFileSettings& settings) {
  ContentHash hash;
  hash.add(contentHash(particles));
  hash.addValues(std::span<const Vec3d>(&settings.origin, 1));
  hash.addValues(std::span<const double>(&settings.voxelSize, 1));
  hash.addValues(std::span<const float>(settings.radius));
  return hash.hex();
}

}  // namespace

std::string particlesToVdb(const FrameParticles& particles, const PointFileSettings& settings) {
  openvdb::initialize();
  return withUuid(SeekableFile().bytes(gridOf(particles, settings)), nameOf(particles, settings));
}

}  // namespace brisance
