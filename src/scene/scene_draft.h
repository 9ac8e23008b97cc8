// A scene in the file's own terms: what is written there, before sizes, defaults and references are worked out.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene_file.h"

namespace brisance {

/// A box of cubic cells, told by two of its three measures, or by its size and how finely to divide it.
struct LatticeKeys {
  std::optional<Vec3d> corner;  ///< [m]
  std::optional<Vec3d> size;    ///< [m]
  std::optional<Vec3i> cells;
  std::optional<double> cellSize;  ///< [m]
  std::optional<int> resolution;   ///< cells along the longest side
};

struct CameraViewKeys {
  CameraKey key;
  std::optional<double> fovDegrees, focalLengthMm;
  std::optional<double> focusDistance;  ///< [m]
  double sensorHeightMm = 24;           ///< of a full-frame camera
};

/// The material of bodies that name none; scenes may declare their own under this name.
constexpr const char* plainMaterial = "plain";

struct BodyKeys {
  BodyKeys() { body.material = plainMaterial; }
  BodySettings body;
  std::optional<double> density, mass, massPerArea;
  std::optional<Vec3d> rotationDegrees;
  std::optional<Quaternion> orientation;
  std::optional<bool> moves;
};

struct NoPattern {};
using Pattern = std::variant<NoPattern, Wood, Marble, Checkerboard>;

struct MaterialKeys {
  std::string name;
  Material material;
  std::optional<Vec3f> colour;
  std::optional<std::filesystem::path> texture;
  Pattern pattern;
};

enum class Quality { none, draft, final };

/// Settings that map one to one are kept in `scene`; the rest is worked out from what stands beside it.
struct SceneDraft {
  Scene scene;
  double metresPerUnit = 1;
  Quality quality = Quality::none;
  int gasResolution = 64, volumeResolution = 200;  ///< where a lattice says nothing of its own
  LatticeKeys gas, volume;
  std::optional<std::uint64_t> renderSeed;
  CameraViewKeys camera;
  std::vector<CameraViewKeys> cameraKeys;
  std::vector<BodyKeys> bodies;
  std::vector<MaterialKeys> materials;
};

/// Changes the defaults that a quality preset stands for.
void applyQuality(SceneDraft& draft, Quality quality);

/// The scene that a draft means. `places` maps paths of keys to "FILE:LINE", with the file's own name at "".
/// Throws InputError where keys contradict one another.
Scene resolve(const SceneDraft& draft, const std::map<std::string, std::string>& places);

/// The draft that writes a scene out: resolve(draftOf(scene)) is the scene.
SceneDraft draftOf(const Scene& scene);

}  // namespace brisance
