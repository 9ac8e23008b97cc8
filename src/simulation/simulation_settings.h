// All that a simulation is told.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fluid/fluid_settings.h"
#include "fracture/fracture.h"
#include "particles/particle_settings.h"
#include "rigid/rigid_settings.h"

namespace brisance {

struct SphereShape {
  double radius = 0.5;  ///< [m]
  int segments = 32;    ///< around the equator
};
struct BoxShape {
  Vec3d size{1, 1, 1};  ///< [m]
  Vec2d uvRepeat{1, 1};
};
struct RectangleShape {
  double width = 1, height = 1;  ///< [m]; in x-y, facing +z; scenery only
  Vec2d uvRepeat{1, 1};
};
struct MeshShape {
  std::filesystem::path file;
  std::shared_ptr<const TriangleMesh> given;  ///< instead of the file, which then is but its name
  double scale = 1;
  double shellThickness = 0.01;  ///< [m] for the mass of open pieces
};
using Shape = std::variant<SphereShape, BoxShape, RectangleShape, MeshShape, PaneSettings>;

/// Mass of the pieces of a body.
struct MassFromDensity {
  double density = 2500;
};  ///< [kg/m3] times volume
struct MassGiven {
  double mass = 1;
};  ///< [kg] of the whole body, shared by volume
struct MassPerArea {
  double perArea = 10;
};  ///< [kg/m2] times the surface (thesis 5.1)
using MassRule = std::variant<MassFromDensity, MassGiven, MassPerArea>;

struct BodySettings {
  std::string name;
  Shape shape;
  Pose pose;
  std::string material;
  bool moves = true;       ///< false: scenery
  bool blocksGas = false;  ///< only for scenery
  MassRule mass;
  FractureSettings fracture;
  double releaseTime = 0;             ///< [s] until then it rests in place
  bool swells = false;                ///< until then gas carries its vertices instead
  double temperature = 300;           ///< [K]
  std::optional<double> warmingTime;  ///< [s] in which it comes to the gas' temperature, to 1/e; none: it keeps its own
  int dust = 0;                       ///< grains that leave its surface when it is released
  double bondStrength = 0;            ///< [Pa] at which its pieces come apart; 0: they are apart from the start
};

/// pass: gas goes through bodies that move, as in the thesis. block: they stop it, and carry it.
enum class BodiesInGas { pass, block };

struct SimulationSettings {
  std::uint64_t seed = 1;
  int frames = 100;
  double frameTime = 1.0 / 24;  ///< [s] of simulated time between frames: time_scale / fps
  int checkpointEvery = 8;      ///< frames
  FluidSettings fluid;
  ParticleSettings particles;
  RigidSettings rigid;
  BodiesInGas bodiesInGas = BodiesInGas::pass;
  std::vector<BodySettings> bodies;
};

}  // namespace brisance
