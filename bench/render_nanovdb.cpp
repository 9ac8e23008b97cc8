#ifdef BRISANCE_HAS_NANOVDB
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/HDDA.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <nanovdb/util/Ray.h>
#include <nanovdb/util/SampleFromVoxels.h>
#include <openvdb/openvdb.h>

#include "base/parallel.h"
#include "render_inputs.h"

namespace brisance::bench {
namespace {

using Handle = nanovdb::GridHandle<nanovdb::HostBuffer>;
using NanoRay = nanovdb::Ray<float>;

struct NanoVolume {
  Handle density, colour;
};

std::shared_ptr<NanoVolume> nanoExplosion() {
  openvdb::initialize();
  const auto density = openvdb::FloatGrid::create(0);
  const auto colour = openvdb::Vec3SGrid::create(openvdb::Vec3f(0));
  auto densities = density->getAccessor();
  auto colours = colour->getAccessor();
  const ParticleVolume& volume = explosion();
  for (int k = 0; k < volume.density.size.z; ++k)
    for (int j = 0; j < volume.density.size.y; ++j)
      for (int i = 0; i < volume.density.size.x; ++i) {
        if (volume.density(i, j, k) <= 0) continue;
        const Vec3f& c = volume.colour(i, j, k);
        densities.setValue(openvdb::Coord(i, j, k), volume.density(i, j, k));
        colours.setValue(openvdb::Coord(i, j, k), openvdb::Vec3f(c.x, c.y, c.z));
      }
  return std::make_shared<NanoVolume>(NanoVolume{nanovdb::openToNanoVDB(*density), nanovdb::openToNanoVDB(*colour)});
}

/// Marches one path in cells.
template <class Accessor, class Density, class Colour>
GasPassage march(Accessor& accessor, const Density& density, const Colour& colour, const GasPath& path,
                 const GasOptics& optics) {
  constexpr float seeThrough = 0.001f;
  const Grid3<float>& grid = explosion().density;
  const Vec3f origin((Vec3d(path.origin) - grid.origin) / grid.cellSize);
  const NanoRay ray(nanovdb::Vec3f(origin.x, origin.y, origin.z),
                    nanovdb::Vec3f(path.direction.x, path.direction.y, path.direction.z));
  const auto cell = static_cast<float>(grid.cellSize);
  GasPassage passage;
  nanovdb::TreeMarcher<nanovdb::LeafNode<float>, NanoRay, Accessor> marcher(accessor);
  if (!marcher.init(ray)) return passage;
  const nanovdb::LeafNode<float>* leaf;
  float from, to;
  while (marcher.step(&leaf, from, to))
    for (float t = std::ceil(from); t < to; t += 1) {
      const auto place = ray(t);
      const float d = density(place);
      if (d <= 0) continue;
      const auto c = colour(place);
      const float passing = std::exp(-optics.extinction(d) * cell);
      passage.light += Vec3f(c[0], c[1], c[2]) * ((1 - passing) * passage.transmittance);
      passage.transmittance *= passing;
      if (passage.transmittance < seeThrough) return passage;
    }
  return passage;
}

}  // namespace

MarchAll makeNanoVdb() {
  return [volume = nanoExplosion()](const std::vector<GasPath>& paths, std::vector<GasPassage>& passages) {
    const GasOptics optics(explosionSettings());
    parallelFor(0, std::ssize(paths), 1024, [&](std::int64_t first, std::int64_t last) {
      auto densities = volume->density.grid<float>()->getAccessor();
      const auto colours = volume->colour.grid<nanovdb::Vec3f>()->getAccessor();
      const auto density = nanovdb::createSampler<1>(densities);
      const auto colour = nanovdb::createSampler<1>(colours);
      for (std::int64_t n = first; n < last; ++n) passages[n] = march(densities, density, colour, paths[n], optics);
    });
  };
}

}  // namespace brisance::bench
#endif
