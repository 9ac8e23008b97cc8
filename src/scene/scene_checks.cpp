#include "scene/scene_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <set>

#include "base/check.h"
#include "scene/scene_text.h"

namespace brisance {
namespace {

std::string shown(const Vec3d& v) { return fmt::format("[{:g}, {:g}, {:g}]", v.x, v.y, v.z); }

void checkFaces(const Scene& scene, const Places& places) {
  const FluidSettings& gas = scene.simulation.fluid;
  const ParticleSettings& particles = scene.simulation.particles;
  for (int axis = 0; axis < 3; ++axis)
    if (isPeriodic(gas.faces, axis) != (gas.faces[upperFaceOf(axis)] == FaceKind::periodic))
      places.refuse("gas.faces", "must be periodic on both faces of an axis or on neither");
  const bool sealed = std::find(gas.faces.begin(), gas.faces.end(), FaceKind::open) == gas.faces.end();
  if (sealed && !gas.removeMeanSource && !particles.charges.empty() && particles.burning.gasPerMass > 0)
    places.refuse("gas.faces",
                  "must leave a face open: a charge makes gas and all six faces are walls "
                  "(or set gas.remove_mean_source = true)");
}

void checkMotion(const Scene& scene, const Places& places) {
  constexpr const char* names[] = {"x_lower", "x_upper", "y_lower", "y_upper", "z_lower", "z_upper"};
  const FluidSettings& gas = scene.simulation.fluid;
  for (std::size_t face = 0; face < gas.faces.size(); ++face) {
    const Vec3d& wall = gas.wallVelocity[face];
    const std::string path = fmt::format("gas.wall_velocity.{}", names[face]);
    if (!(wall == Vec3d{}) && gas.faces[face] != FaceKind::noSlip)
      places.refuse(path, "must be zero: this face is not no_slip");
    if (wall[static_cast<int>(face) / 2] != 0)
      places.refuse(path, fmt::format("must lie in the face, got {} [m/s]", shown(wall)));
  }
  for (std::size_t i = 0; i < gas.stirring.size(); ++i)
    if (length(gas.stirring[i].axis) == 0) places.refuse(fmt::format("gas.stirring.{}.axis", i), "must not be zero");
  constexpr double mostCourant = 1;  // beyond which steps through fluxes are unstable
  if (gas.courant > mostCourant && !std::holds_alternative<SemiLagrangian>(gas.advection))
    places.refuse("gas.courant",
                  fmt::format("must be at most 1 unless gas.advection is semi_lagrangian, got {:g}", gas.courant));
}

void checkTemperatures(const Scene& scene, const Places& places) {
  const FluidSettings& gas = scene.simulation.fluid;
  if (gas.maximumTemperature <= gas.ambientTemperature)
    places.refuse("gas.maximum_temperature", fmt::format("must be above gas.ambient_temperature, {} [K], got {}",
                                                         gas.ambientTemperature, gas.maximumTemperature));
}

void checkCharge(const Charge& charge, const FluidSettings& gas, const std::string& path, const Places& places) {
  const Vec3d reach(charge.radius, charge.radius, charge.radius);
  const Box3 box{gas.corner, gas.corner + Vec3d(gas.cells) * gas.cellSize};
  if (!box.contains(charge.position - reach) || !box.contains(charge.position + reach))
    places.refuse(path + ".position",
                  fmt::format("must lie with its radius {:g} inside the gas box {} to {} [m], got {}", charge.radius,
                              shown(box.lower), shown(box.upper), shown(charge.position)));
  if (charge.ignited > charge.particles)
    places.refuse(path + ".ignited",
                  fmt::format("must be at most particles, {}, got {}", charge.particles, charge.ignited));
}

/// Emission at a rate for a long time, or a fine soot threshold, would make particles without end.
void checkParticleCount(const Scene& scene, const Places& places) {
  constexpr double mostSoot = 1e4;     // per fuel particle: far finer than a picture shows
  constexpr double mostEmitted = 1e8;  // of one charge: what fits the memory of a large machine
  const BurnSettings& burning = scene.simulation.particles.burning;
  const double leastThreshold = burning.mass * burning.sootPerMass / mostSoot;
  if (!burning.sootOnce && burning.sootThreshold < leastThreshold)
    places.refuse(
        "explosion.soot_threshold",
        fmt::format("must be at least {:g} [kg], so that a fuel particle makes at most {} soot particles, got {:g}",
                    leastThreshold, mostSoot, burning.sootThreshold));
  const std::vector<Charge>& charges = scene.simulation.particles.charges;
  for (std::size_t i = 0; i < charges.size(); ++i)
    if (charges[i].emissionRate * charges[i].emissionTime > mostEmitted)
      places.refuse(fmt::format("explosion.charges.{}.emission_rate", i),
                    fmt::format("must make at most {:g} particles in emission_time, {:g} [s], got {:g}", mostEmitted,
                                charges[i].emissionTime, charges[i].emissionRate));
}

void checkName(const std::string& name, const std::string& path, const Places& places) {
  constexpr std::size_t longestName = 100;
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  if (!plain || name.size() > longestName)
    places.refuse(path + ".name",
                  fmt::format("must be at most {} letters, digits, _ and -, got \"{}\"", longestName, quoted(name)));
}

/// Triangles that a pane has at least: points on the border add more.
int paneTriangles(const PaneSettings& pane) {
  const auto corners = outlineCorners(pane.outline, std::numeric_limits<double>::infinity()).size();
  return static_cast<int>(corners) - 2 + 2 * pane.points;
}

/// Triangles of a shape where they are known before it is made; fewer pieces than that come out of it.
int knownTriangles(const Shape& shape) {
  constexpr int boxTriangles = 12;
  if (const auto* pane = std::get_if<PaneSettings>(&shape)) return paneTriangles(*pane);
  if (std::holds_alternative<BoxShape>(shape)) return boxTriangles;
  return std::numeric_limits<int>::max();
}

void checkPane(const PaneSettings& pane, const std::string& path, const Places& places) {
  if (const std::string fault = outlineFault(pane.outline); !fault.empty()) places.refuse(path + ".outline", fault);
  if (const std::string fault = patternFault(pane.pattern, pane.outline); !fault.empty())
    places.refuse(path + ".pattern", fault);
}

void checkFracture(const BodySettings& body, const std::string& path, const Places& places) {
  const FractureSettings& fracture = body.fracture;
  const int pieces = fracture.pieces;
  const bool cutsTriangles = !fracture.solid.enabled || std::holds_alternative<PaneSettings>(body.shape);
  if (pieces > 1 && !body.moves)
    places.refuse(path + ".pieces", fmt::format("must be 1: scenery stays whole, got {}", pieces));
  if (cutsTriangles && pieces > knownTriangles(body.shape))
    places.refuse(path + ".pieces", fmt::format("must be at most the {} triangles of the shape, got {}",
                                                knownTriangles(body.shape), pieces));
  if (!std::holds_alternative<BreadthFirstThesis>(fracture.method)) return;
  if (!cutsTriangles)
    places.refuse(path + ".method", "must be another for solid pieces: breadth_first_thesis cuts triangles");
  if (!std::has_single_bit(static_cast<unsigned>(pieces)))
    places.refuse(path + ".pieces", fmt::format("must be a power of two for breadth_first_thesis, got {}", pieces));
}

void checkMesh(const MeshShape& mesh, const std::string& path, const Places& places) {
  if (mesh.file.extension() == ".gltf")
    places.refuse(path + ".file",
                  "must be .glb, .obj, .ply or .stl: a .gltf keeps its vertices in other files, which a "
                  "run would not hold");
}

void checkBody(const BodySettings& body, const std::string& path, const Places& places) {
  checkName(body.name, path, places);
  if (const auto* pane = std::get_if<PaneSettings>(&body.shape)) checkPane(*pane, path + ".shape", places);
  if (const auto* mesh = std::get_if<MeshShape>(&body.shape)) checkMesh(*mesh, path + ".shape", places);
  const bool rectangle = std::holds_alternative<RectangleShape>(body.shape);
  if (rectangle && body.moves) places.refuse(path + ".moves", "must be false: a rectangle is scenery");
  if (body.blocksGas && (body.moves || rectangle))
    places.refuse(path + ".blocks_gas", "must be false: only solid scenery (moves = false, no rectangle) blocks gas");
  if (body.swells && (!body.moves || body.fracture.solid.enabled || std::holds_alternative<PaneSettings>(body.shape)))
    places.refuse(path + ".swells", "must be false: only a hollow body that moves swells, no pane and no solid pieces");
  checkFracture(body, path + ".fracture", places);
}

void checkBodies(const Scene& scene, const Places& places) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.simulation.bodies.size(); ++i) {
    const BodySettings& body = scene.simulation.bodies[i];
    const std::string path = places.elementPath("bodies", body.name, i);
    checkBody(body, path, places);
    if (body.swells && scene.simulation.bodiesInGas == BodiesInGas::block)
      places.refuse(path + ".swells", "must be false where gas.bodies is block: gas passes through what it swells");
    if (!names.insert(body.name).second)
      places.refuse(path + ".name", fmt::format("must be unique, \"{}\" is there twice", body.name));
    if (scene.render.materials.count(body.material) != 0) continue;
    std::vector<std::string> known;
    for (const auto& [name, material] : scene.render.materials) known.push_back(name);
    places.refuse(path + ".material", fmt::format("must name one of the materials ({}), got \"{}\"",
                                                  quoted(joined(known, ", ")), quoted(body.material)));
  }
}

void checkFlow(const Scene& scene, const Places& places) {
  const FlowSettings& flow = scene.render.flow;
  if (!flow.drawn) return;
  constexpr double mostArrows = 1e5;
  double arrows = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (flow.upper[axis] < flow.lower[axis])
      places.refuse("render.flow.upper",
                    fmt::format("must not lie below lower, {} [m], got {}", shown(flow.lower), shown(flow.upper)));
    arrows *= 1 + (flow.upper[axis] - flow.lower[axis]) / flow.spacing;
  }
  if (arrows > mostArrows)
    places.refuse("render.flow.spacing", fmt::format("must leave at most {:g} arrows, got {:.3g}", mostArrows, arrows));
}

void checkPicture(const Scene& scene, const Places& places) {
  const VolumeSettings& volume = scene.render.volume;
  if (volume.minDensity >= volume.maxDensity)
    places.refuse("render.volume.min_density",
                  fmt::format("must be below max_density, {}, got {}", volume.maxDensity, volume.minDensity));
  if (volume.filterSize != 0 && volume.filterSize % 2 == 0)
    places.refuse("render.volume.filter_size",
                  fmt::format("must be odd, or 0 for three deviations, got {}", volume.filterSize));
  if (scene.render.denoise && std::holds_alternative<WhittedIntegrator>(scene.render.integrator))
    places.refuse("render.denoise", "must be false unless render.integrator is path: the other has no noise of chance");
  if (scene.render.denoise && scene.render.samples < 2)
    places.refuse("render.denoise", "needs render.samples of at least 2: half of them judge the other half");
  if (scene.render.samples != std::floor(scene.render.samples) && !samplesGoByNoise(scene.render))
    places.refuse("render.samples",
                  fmt::format("must be whole unless render.integrator is path, adaptive and without denoise, got {}",
                              scene.render.samples));
  checkFlow(scene, places);
  for (std::size_t i = 0; i < scene.render.lights.size(); ++i) {
    const auto* sun = std::get_if<SunLight>(&scene.render.lights[i]);
    if (sun != nullptr && length(sun->direction) == 0)
      places.refuse(fmt::format("lights.{}.direction", i), "must not be zero");
  }
}

}  // namespace

std::string Places::of(std::string path) const {
  for (;;) {
    const auto found = lines.find(path);
    if (found != lines.end()) return found->second;
    const std::size_t dot = path.rfind('.');
    if (path.empty()) return "scene";
    path = dot == std::string::npos ? "" : path.substr(0, dot);
  }
}

std::string Places::elementPath(const std::string& array, const std::string& name, std::size_t index) const {
  const std::string named = array + "." + name, numbered = fmt::format("{}.{}", array, index);
  const auto byName = lines.find(named), byNumber = lines.find(numbered);
  const bool same = byName != lines.end() && byNumber != lines.end() && byName->second == byNumber->second;
  return same ? named : numbered;
}

void Places::refuse(const std::string& path, const std::string& what) const {
  throw InputError(fmt::format("{}: {}: {}", of(path), path, what));
}

void collectInputs(Scene& scene) {
  const auto add = [&](const std::filesystem::path& file) {
    if (std::find(scene.inputs.begin(), scene.inputs.end(), file) == scene.inputs.end()) scene.inputs.push_back(file);
  };
  for (const BodySettings& body : scene.simulation.bodies)
    if (const auto* mesh = std::get_if<MeshShape>(&body.shape); mesh && !mesh->given) add(mesh->file);
  for (const auto& [name, material] : scene.render.materials)
    if (const auto* image = std::get_if<ImageTexture>(&material.diffuse)) add(image->file);
  if (scene.render.environment.file) add(*scene.render.environment.file);
}

void checkTogether(const Scene& scene, const Places& places) {
  const SimulationSettings& s = scene.simulation;
  if (std::holds_alternative<Pressure>(s.rigid.push) && s.bodiesInGas == BodiesInGas::pass)
    places.refuse("rigid.push", "pressure pushes only what blocks the gas: set gas.bodies = \"block\"");
  checkFaces(scene, places);
  checkMotion(scene, places);
  checkTemperatures(scene, places);
  const std::vector<Charge>& charges = scene.simulation.particles.charges;
  for (std::size_t i = 0; i < charges.size(); ++i)
    checkCharge(charges[i], scene.simulation.fluid, fmt::format("explosion.charges.{}", i), places);
  checkParticleCount(scene, places);
  checkBodies(scene, places);
  checkPicture(scene, places);
}

}  // namespace brisance
