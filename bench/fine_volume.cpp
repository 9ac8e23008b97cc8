// Writes the gas of a frame as the renderer sees it: opacity [1/m] and the light that opaque gas gives off, on the
// renderer's own fine grid, z up as a glTF file lies in Blender. usage: fine_volume RUN FRAME OUT.vdb
#include <openvdb/openvdb.h>

#include <cstdio>

#include "frame/run_directory.h"
#include "render/blackbody.h"
#include "render/gas_medium.h"
#include "scene/scene_file.h"

namespace brisance {
namespace {

ParticleVolume volumeOf(const FrameParticles& particles, const VolumeSettings& settings) {
  const BlackbodyColours heat(settings.blackbody);
  const auto weigh = [&](std::size_t p) {
    constexpr int unburnt = 0, burning = 1;
    const int kind = particles.kind[p];
    return kind == unburnt   ? 0
           : kind == burning ? particles.mass[p] * static_cast<float>(settings.fuelWeight)
                             : particles.mass[p];
  };
  return splatParticles(
      particles, {settings.cells, settings.corner, settings.cellSize, settings.blur, settings.filterSize}, weigh, heat);
}

template <class Grid>
typename Grid::Ptr gridOf(const std::string& name, const Grid3<float>& density) {
  const auto grid = Grid::create();
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  const auto transform = openvdb::math::Transform::createLinearTransform(density.cellSize);
  const Vec3d last = density.position(density.size.x - 1, density.size.y - 1, density.size.z - 1);
  transform->postTranslate({density.origin.x, -last.z, density.origin.y});
  grid->setTransform(transform);
  return grid;
}

void write(const ParticleVolume& volume, const VolumeSettings& settings, const std::string& file) {
  openvdb::initialize();
  const GasOptics optics(settings);
  const auto opacity = gridOf<openvdb::FloatGrid>("density", volume.density);
  const auto glow = gridOf<openvdb::Vec3SGrid>("glow", volume.density);
  auto opacities = opacity->getAccessor();
  auto glows = glow->getAccessor();
  const Vec3i n = volume.density.size;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        const float kappa = optics.extinction(volume.density(i, j, k));
        if (kappa <= 0) continue;
        const openvdb::Coord at(i, n.z - 1 - k, j);
        const Vec3f light = optics.glow(volume.colour(i, j, k)) * kappa;  // per metre
        opacities.setValue(at, kappa);
        glows.setValue(at, {light.x, light.y, light.z});
      }
  openvdb::io::File(file).write({opacity, glow});
}

}  // namespace
}  // namespace brisance

int main(int argc, char** argv) {
  using namespace brisance;
  if (argc != 4) {
    std::fputs("usage: fine_volume RUN FRAME OUT.vdb\n", stderr);
    return 2;
  }
  const VolumeSettings settings = readScene(std::filesystem::path(argv[1]) / "scene.toml").render.volume;
  write(volumeOf(readFrame(argv[1], std::atoi(argv[2]), false).particles, settings), settings, argv[3]);
}
