// A film's bodies and gas as one USD text layer (.usda).
#pragma once

#include <string>
#include <vector>

#include "frame/run_motion.h"
#include "frame/surface_look.h"

namespace brisance {

/// The gas of a frame as a file that the layer points to.
struct GasFile {
  int frame = 1;
  std::string path;  ///< from the layer: "../run/gas/gas.0001.vdb"
};

struct UsdSettings {
  double fps = 24;  ///< frames of film per second: time codes are frame numbers
  SurfaceLooks looks;
  std::vector<GasFile> gas;  ///< empty: no gas
  Box3 gasBox;               ///< [m] in which it is
};

/// Metres, y up. An Xform per body under /World/Bodies with a Mesh, its position and rotation sampled at the keys that
/// say all (neededKeys); materials as UsdPreviewSurface, faces of several materials as subsets; the gas as a Volume of
/// OpenVDB fields. Throws DamagedFile when a picture cannot be read.
std::string motionToUsda(const RunMotion& motion, const UsdSettings& settings);

}  // namespace brisance
