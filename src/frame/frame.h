// The snapshot of a moment: simulation ends in one, pictures and exports begin from one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/report.h"
#include "grid/sparse_grid.h"
#include "mesh/triangle_mesh.h"

namespace brisance {

struct FrameBody {
  std::string name;                          ///< unique in the frame: "pane.007"
  std::shared_ptr<const TriangleMesh> mesh;  ///< about its own origin, shared between frames
  std::string material;                      ///< by name, looked up by the renderer
  Pose pose;
  Vec3d linearVelocity;    ///< [m/s]
  Vec3d angularVelocity;   ///< [1/s]
  double temperature = 0;  ///< [K]
  bool moves = true;       ///< false: scenery
  int shapeFrame = 0;      ///< frame in which its mesh last took another shape; 0: as it was at rest
};

enum class FrameKind : std::uint8_t { unburntFuel = 0, burningFuel = 1, soot = 2, spark = 3, dust = 4 };

/// One entry per particle in each array.
struct FrameParticles {
  std::vector<Vec3f> position;     ///< [m]
  std::vector<Vec3f> velocity;     ///< [m/s]
  std::vector<float> mass;         ///< [kg]
  std::vector<float> temperature;  ///< [K]
  std::vector<std::uint8_t> kind;  ///< a FrameKind
  friend bool operator==(const FrameParticles&, const FrameParticles&) = default;
};

struct FrameGas {
  SparseGrid<float> density;      ///< soot [kg/m3]
  SparseGrid<float> temperature;  ///< [K], background ambient
  SparseGrid<float> flame;        ///< fuel burnt in the last moments [kg/m3]
  SparseGrid<Vec3f> velocity;     ///< [m/s] at cell centres
  friend bool operator==(const FrameGas&, const FrameGas&) = default;
};

/// Immutable once made. The picture's fine volume is built from it and never stored.
struct Frame {
  int index = 1;    ///< from 1
  double time = 0;  ///< [s]
  FrameGas gas;
  std::vector<FrameBody> bodies;
  FrameParticles particles;
  StepReport report;
};

}  // namespace brisance
