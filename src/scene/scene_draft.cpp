#include "scene/scene_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/check.h"
#include "scene/scene_checks.h"

namespace brisance {
namespace {

constexpr double degree = pi / 180;
constexpr int mostCells = 4096;        // along a side
constexpr double latticeSlack = 1e-6;  // of a cell, or of the size: what decimal fractions leave of an exact multiple

/// What a preset stands for.
struct Preset {
  int width, height, samples, gasResolution, volumeResolution;
};
constexpr Preset draftPreset{320, 240, 1, 32, 96};
constexpr Preset finalPreset{960, 720, 3, 96, 300};

/// A box of cubic cells, worked out.
struct Lattice {
  Vec3d corner;
  Vec3i cells;
  double cellSize;
};

double longest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

double cellSizeOf(const LatticeKeys& keys, int resolution) {
  if (keys.cellSize) return *keys.cellSize;
  const double side = keys.size ? longest(*keys.size) : 1.0;
  if (keys.cells) return side / std::max({keys.cells->x, keys.cells->y, keys.cells->z});
  return side / keys.resolution.value_or(resolution);
}

/// Enough whole cells to cover the size.
Vec3i cellsOf(const LatticeKeys& keys, double cellSize, const std::string& path, const Places& places) {
  if (keys.cells) return *keys.cells;
  const Vec3d size = keys.size.value_or(Vec3d(1, 1, 1));
  Vec3i cells;
  for (int axis = 0; axis < 3; ++axis) {
    const double count = std::max(1.0, std::ceil(size[axis] / cellSize - latticeSlack));
    if (!(count <= mostCells))
      places.refuse(path + ".cell_size",
                    fmt::format("must make at most {} cells along a side, makes {:g}", mostCells, count));
    cells[axis] = static_cast<int>(count);
  }
  return cells;
}

void checkLattice(const LatticeKeys& keys, const std::string& path, const Places& places) {
  if (keys.resolution && (keys.cells || keys.cellSize))
    places.refuse(path + ".resolution",
                  fmt::format("must not stand beside {}, which says the same", keys.cells ? "cells" : "cell_size"));
}

void checkLatticeSize(const LatticeKeys& keys, const Lattice& lattice, const std::string& path, const Places& places) {
  if (!keys.cells || !keys.size) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = (*keys.size)[axis], made = lattice.cells[axis] * lattice.cellSize;
    if (std::abs(made - size) > latticeSlack * longest(*keys.size))
      places.refuse(path + ".cells",
                    fmt::format("must fill {}.size with cubes: {} cells of {:g} m along {} make {:g} m, got {:g} m",
                                path, lattice.cells[axis], lattice.cellSize, "xyz"[axis], made, size));
  }
}

Lattice latticeOf(const LatticeKeys& keys, int resolution, const std::string& path, const Places& places) {
  checkLattice(keys, path, places);
  Lattice lattice{keys.corner.value_or(Vec3d()), {}, cellSizeOf(keys, resolution)};
  lattice.cells = cellsOf(keys, lattice.cellSize, path, places);
  checkLatticeSize(keys, lattice, path, places);
  return lattice;
}

/// The volume covers the gas box where it does not say otherwise.
LatticeKeys volumeKeys(LatticeKeys keys, const FluidSettings& gas) {
  const Vec3d gasSize = Vec3d(gas.cells) * gas.cellSize;
  if (!keys.corner) keys.corner = gas.corner;
  if (keys.size) return keys;
  if (!keys.cells)
    keys.size = gasSize;
  else if (!keys.cellSize)
    keys.cellSize = std::max({gasSize.x / keys.cells->x, gasSize.y / keys.cells->y, gasSize.z / keys.cells->z});
  return keys;
}

void resolveLattices(const SceneDraft& draft, Scene& scene, const Places& places) {
  FluidSettings& gas = scene.simulation.fluid;
  const Lattice box = latticeOf(draft.gas, draft.gasResolution, "gas", places);
  gas.corner = box.corner, gas.cells = box.cells, gas.cellSize = box.cellSize;
  const Lattice fine = latticeOf(volumeKeys(draft.volume, gas), draft.volumeResolution, "render.volume", places);
  VolumeSettings& volume = scene.render.volume;
  volume.corner = fine.corner, volume.cells = fine.cells, volume.cellSize = fine.cellSize;
}

double fieldOfView(const CameraViewKeys& view, double otherwise) {
  if (view.focalLengthMm) return 2 * std::atan(view.sensorHeightMm / (2 * *view.focalLengthMm)) / degree;
  return view.fovDegrees.value_or(otherwise);
}

void checkView(const CameraViewKeys& view, const std::string& path, const Places& places) {
  if (view.fovDegrees && view.focalLengthMm)
    places.refuse(path + ".focal_length_mm", "must not stand beside fov_degrees, which says the same");
  const Vec3d ahead = view.key.lookAt - view.key.position;
  if (length(ahead) == 0) places.refuse(path + ".look_at", "must differ from position, got the same place");
  constexpr double leastAngle = 1e-6;  // radians between up and the line of sight
  if (length(cross(normalized(ahead), normalized(view.key.up))) < leastAngle)
    places.refuse(path + ".up", "must not lie along the line of sight and not be zero");
}

void resolveCamera(const SceneDraft& draft, Scene& scene, const Places& places) {
  std::vector<CameraKey>& keys = scene.render.camera.keys;
  const auto add = [&](const CameraViewKeys& view, double fov, const std::string& path) {
    checkView(view, path, places);
    keys.push_back(view.key);
    keys.back().fovDegrees = fieldOfView(view, fov);
    keys.back().focusDistance = view.focusDistance.value_or(length(view.key.lookAt - view.key.position));
  };
  if (draft.cameraKeys.empty()) return add(draft.camera, draft.camera.key.fovDegrees, "camera");
  const double fov = fieldOfView(draft.camera, draft.camera.key.fovDegrees);
  for (std::size_t i = 0; i < draft.cameraKeys.size(); ++i) {
    const std::string path = fmt::format("camera.keys.{}", i);
    add(draft.cameraKeys[i], fov, path);
    if (i > 0 && keys[i].time <= keys[i - 1].time)
      places.refuse(path + ".time", fmt::format("must be above that of the key before, {} [s], got {}",
                                                keys[i - 1].time, keys[i].time));
  }
}

MassRule massOf(const BodyKeys& keys, const std::string& path, const Places& places) {
  if (keys.density.has_value() + keys.mass.has_value() + keys.massPerArea.has_value() > 1)
    places.refuse(path + (keys.massPerArea ? ".mass_per_area" : ".mass"),
                  "must stand alone: at most one of density, mass and mass_per_area");
  if (keys.mass) return MassGiven{*keys.mass};
  if (keys.massPerArea) return MassPerArea{*keys.massPerArea};
  return keys.density ? MassFromDensity{*keys.density} : MassFromDensity{};
}

Quaternion orientationOf(const BodyKeys& keys, const std::string& path, const Places& places) {
  if (keys.rotationDegrees && keys.orientation)
    places.refuse(path + ".orientation", "must not stand beside rotation_degrees, which says the same");
  if (keys.rotationDegrees) {
    const Vec3d turn = *keys.rotationDegrees * degree;
    return normalized(axisAngle({0, 0, 1}, turn.z) * axisAngle({0, 1, 0}, turn.y) * axisAngle({1, 0, 0}, turn.x));
  }
  const Quaternion q = keys.orientation.value_or(Quaternion{});
  const double norm = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  if (norm == 0) places.refuse(path + ".orientation", "must not be zero");
  constexpr double unitSlack = 1e-12;  // a unit quaternion that was written out reads back as it was
  return std::abs(norm - 1) < unitSlack ? q : normalized(q);
}

void resolveBodies(const SceneDraft& draft, Scene& scene, const Places& places) {
  for (std::size_t i = 0; i < draft.bodies.size(); ++i) {
    const BodyKeys& keys = draft.bodies[i];
    const std::string path = places.elementPath("bodies", keys.body.name, i);
    BodySettings body = keys.body;
    body.mass = massOf(keys, path, places);
    body.pose.orientation = orientationOf(keys, path, places);
    body.moves = keys.moves.value_or(!std::holds_alternative<RectangleShape>(body.shape));
    scene.simulation.bodies.push_back(body);
  }
}

struct PatternTexture {
  Texture& diffuse;
  void operator()(const NoPattern&) const {}
  template <class Kind>
  void operator()(const Kind& pattern) const {
    diffuse = pattern;
  }
};

void usePattern(const MaterialKeys& keys, Material& material, const std::string& path, const Places& places) {
  if (std::holds_alternative<NoPattern>(keys.pattern)) return;
  if (keys.colour || keys.texture) places.refuse(path + ".pattern", "must not stand beside colour or texture");
  std::visit(PatternTexture{material.diffuse}, keys.pattern);
}

/// The pattern that a texture is, if any.
struct PatternOf {
  template <class Other>
  Pattern operator()(const Other&) const {
    return NoPattern{};
  }
  Pattern operator()(const Wood& wood) const { return wood; }
  Pattern operator()(const Marble& marble) const { return marble; }
  Pattern operator()(const Checkerboard& board) const { return board; }
};

void resolveMaterials(const SceneDraft& draft, Scene& scene, const Places& places) {
  scene.render.materials.emplace(plainMaterial, Material{});
  std::set<std::string> names;
  for (std::size_t i = 0; i < draft.materials.size(); ++i) {
    const MaterialKeys& keys = draft.materials[i];
    const std::string path = places.elementPath("materials", keys.name, i);
    if (!names.insert(keys.name).second)
      places.refuse(path + ".name", fmt::format("must be unique, \"{}\" is there twice", keys.name));
    if (keys.colour && keys.texture) places.refuse(path + ".texture", "must not stand beside colour");
    Material material = keys.material;
    if (keys.colour) material.diffuse = SolidColour{*keys.colour};
    if (keys.texture) material.diffuse = ImageTexture{*keys.texture};
    usePattern(keys, material, path, places);
    scene.render.materials[keys.name] = material;
  }
}

LatticeKeys latticeKeys(const Vec3d& corner, const Vec3i& cells, double cellSize) {
  return {corner, {}, cells, cellSize, {}};
}

BodyKeys keysOf(const BodySettings& body) {
  BodyKeys keys;
  keys.body = body;
  keys.moves = body.moves;
  keys.orientation = body.pose.orientation;
  if (const auto* density = std::get_if<MassFromDensity>(&body.mass)) keys.density = density->density;
  if (const auto* mass = std::get_if<MassGiven>(&body.mass)) keys.mass = mass->mass;
  if (const auto* area = std::get_if<MassPerArea>(&body.mass)) keys.massPerArea = area->perArea;
  return keys;
}

MaterialKeys keysOf(const std::string& name, const Material& material) {
  MaterialKeys keys{name, material, {}, {}, std::visit(PatternOf{}, material.diffuse)};
  if (const auto* colour = std::get_if<SolidColour>(&material.diffuse)) keys.colour = colour->colour;
  if (const auto* image = std::get_if<ImageTexture>(&material.diffuse)) keys.texture = image->file;
  return keys;
}

CameraViewKeys keysOf(const CameraKey& key) {
  CameraViewKeys view;
  view.key = key;
  view.fovDegrees = key.fovDegrees;
  view.focusDistance = key.focusDistance;
  return view;
}

}  // namespace

void applyQuality(SceneDraft& draft, Quality quality) {
  if (quality == Quality::none) return;
  const Preset& preset = quality == Quality::draft ? draftPreset : finalPreset;
  draft.scene.render.width = preset.width;
  draft.scene.render.height = preset.height;
  draft.scene.render.samples = preset.samples;
  draft.gasResolution = preset.gasResolution;
  draft.volumeResolution = preset.volumeResolution;
}

Scene resolve(const SceneDraft& draft, const std::map<std::string, std::string>& lines) {
  const Places places{lines};
  Scene scene = draft.scene;
  scene.simulation.frameTime = scene.film.timeScale / scene.film.fps;
  scene.render.seed = draft.renderSeed.value_or(scene.simulation.seed);
  resolveLattices(draft, scene, places);
  resolveCamera(draft, scene, places);
  resolveMaterials(draft, scene, places);
  resolveBodies(draft, scene, places);
  collectInputs(scene);
  checkTogether(scene, places);
  return scene;
}

SceneDraft draftOf(const Scene& scene) {
  SceneDraft draft;
  draft.scene = scene;
  const FluidSettings& gas = scene.simulation.fluid;
  const VolumeSettings& volume = scene.render.volume;
  draft.gas = latticeKeys(gas.corner, gas.cells, gas.cellSize);
  draft.volume = latticeKeys(volume.corner, volume.cells, volume.cellSize);
  draft.renderSeed = scene.render.seed;
  draft.camera = keysOf(scene.render.camera.keys.front());
  const auto& keys = scene.render.camera.keys;
  const bool still = keys.size() == 1 && keys.front().time == 0;
  for (std::size_t i = 0; !still && i < keys.size(); ++i) draft.cameraKeys.push_back(keysOf(keys[i]));
  for (const BodySettings& body : scene.simulation.bodies) draft.bodies.push_back(keysOf(body));
  for (const auto& [name, material] : scene.render.materials) draft.materials.push_back(keysOf(name, material));
  return draft;
}

}  // namespace brisance
