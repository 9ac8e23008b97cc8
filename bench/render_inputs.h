// What the benchmarks of the renderer look at.
#pragma once

#include <functional>

#include "frame/frame.h"
#include "frame/particle_volume.h"
#include "render/gas_medium.h"
#include "render/scene_geometry.h"

namespace brisance::bench {

/// A rough ball of some 920 000 triangles within a shell of 100 000.
std::vector<FrameBody> noisyBalls();
/// 512 pieces of a pane in flight.
std::vector<FrameBody> shards();

/// Rays from a pinhole at z = 2.6 towards the origin through 1024 x 1024 pixels, 4 x 4 pixels after one another.
std::vector<Ray> cameraRays();
/// From where those rays arrive, one each in a direction drawn by its cosine.
std::vector<Ray> bouncedRays(const SceneGeometry& geometry, const std::vector<Ray>& from);

/// A ball of fire with whirls in it, 300^3 cells, about two fifths of them filled.
const ParticleVolume& explosion();
VolumeSettings explosionSettings();
/// Through 1920 x 1080 pixels, 4 x 4 after one another.
std::vector<GasPath> pathsThroughExplosion();
/// The same integral in double precision and steps of an eighth of a cell.
GasPassage finePassage(const GasPath& path);

/// What the peers do.
struct RayCounts {
  std::int64_t hits = 0;
  double distances = 0;
};
/// Raw Embree over one mesh of all bodies, at the build quality of SceneGeometry. `robust` as SceneGeometry is.
using EmbreeRays = std::function<RayCounts(const std::vector<Ray>&)>;
EmbreeRays makeEmbreePackets(const std::vector<FrameBody>& bodies, bool robust);
EmbreeRays makeEmbreeSingles(const std::vector<FrameBody>& bodies, bool robust);
/// NanoVDB's tree marcher with trilinear samples, a cell apart, of density and colour.
using MarchAll = std::function<void(const std::vector<GasPath>&, std::vector<GasPassage>&)>;
MarchAll makeNanoVdb();

}  // namespace brisance::bench
