// Particles as OpenVDB points, one grid `particles` a file: what Houdini calls VDB points.
#pragma once

#include <array>
#include <string>

#include "frame/frame.h"

namespace brisance {

struct PointFileSettings {
  Vec3d origin;                   ///< [m] middle of voxel (0, 0, 0)
  double voxelSize = 0.1;         ///< [m]
  std::array<float, 5> radius{};  ///< [m] `pscale` of each FrameKind
};

/// The bytes of a VDB file with a PointDataGrid; equal particles, equal bytes. Attributes, all without loss: P (place
/// in the voxel), v [m/s], temperature [K], mass [kg], pscale [m]: floats; kind: int32, a FrameKind. Positions keep the
/// accuracy of their floats, since the voxel is known exactly.
std::string particlesToVdb(const FrameParticles& particles, const PointFileSettings& settings);

}  // namespace brisance
