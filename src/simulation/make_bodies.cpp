#include "simulation/make_bodies.h"

#include "mesh/mesh_file.h"
#include "mesh/mesh_repair.h"
#include "mesh/shapes.h"

namespace brisance {

namespace {
/// Thickness of the surfaces of scenery and of broken solids [m], which have no inside.
constexpr double surfaceThickness = 0.01;

FracturedBody breakShape(const SphereShape& sphere, const FractureSettings& fracture, std::uint64_t) {
  return fractureMesh(sphereMesh(sphere.radius, sphere.segments), fracture, surfaceThickness);
}
FracturedBody breakShape(const BoxShape& box, const FractureSettings& fracture, std::uint64_t) {
  return fractureMesh(boxMesh(box.size, true, box.uvRepeat), fracture, surfaceThickness);
}
FracturedBody breakShape(const RectangleShape& r, const FractureSettings& fracture, std::uint64_t) {
  return fractureMesh(rectangleMesh(r.width, r.height, r.uvRepeat), fracture, surfaceThickness);
}
FracturedBody breakShape(const MeshShape& shape, const FractureSettings& fracture, std::uint64_t) {
  TriangleMesh mesh = shape.given ? *shape.given : readMesh(shape.file);
  if (fracture.solid.enabled) {
    RepairedMesh repaired = repair(mesh);
    requireSolid(repaired, shape.file);
    mesh = std::move(repaired.mesh);
  }
  for (Vec3d& v : mesh.vertices) v *= shape.scale;
  const bool breaks = fracture.pieces > 1;  // cuts that have not opened shall not be seen in the shading
  if (breaks && mesh.normals.empty()) mesh.normals = vertexNormals(mesh);
  return fractureMesh(mesh, fracture, shape.shellThickness);
}
FracturedBody breakShape(const PaneSettings& pane, const FractureSettings& fracture, std::uint64_t seed) {
  return fracturePane(pane, fracture, seed);
}

double massOf(const Piece& piece, const MassRule& rule, double wholeVolume) {
  struct Rule {
    const Piece& piece;
    double wholeVolume;
    double operator()(const MassFromDensity& m) const { return m.density * piece.properties.volume; }
    double operator()(const MassGiven& m) const { return m.mass * piece.properties.volume / wholeVolume; }
    double operator()(const MassPerArea& m) const { return m.perArea * piece.properties.area; }
  };
  return std::visit(Rule{piece, wholeVolume}, rule);
}

void addPiece(const BodySettings& settings, std::uint32_t origin, const Piece& piece, const std::string& name,
              double mass, WorldState& world) {
  RigidBodies& bodies = world.bodies;
  const bool moves = settings.moves;
  if (moves && !(mass > 0))
    throw InputError(fmt::format("bodies.{}: piece {} has no mass: give it a density, a mass or a closed mesh",
                                 settings.name, name));
  bodies.name.push_back(name);
  bodies.position.push_back(settings.pose * piece.place);
  bodies.orientation.push_back(settings.pose.orientation);
  bodies.linearVelocity.emplace_back();
  bodies.angularVelocity.emplace_back();
  bodies.inverseMass.push_back(moves ? 1 / mass : 0);
  bodies.inertia.push_back(moves ? piece.properties.inertia * (mass / piece.properties.volume) : Mat3{});
  bodies.mesh.push_back(std::make_shared<const TriangleMesh>(piece.mesh));
  bodies.area.push_back(piece.properties.area);
  bodies.releaseTime.push_back(settings.releaseTime);
  bodies.origin.push_back(origin);
  world.looks.push_back(
      {settings.material, settings.temperature, moves, settings.warmingTime, settings.swells, settings.swells, 0});
}
/// Joins the pieces that were added last.
void addBonds(const BodySettings& settings, const FracturedBody& broken, RigidBodies& bodies) {
  if (settings.bondStrength == 0 || !settings.moves) return;
  const auto first = static_cast<std::uint32_t>(bodies.size() - broken.pieces.size());
  for (const Bond& bond : broken.bonds) {
    if (!(bond.area > 0)) continue;
    const std::uint32_t a = first + static_cast<std::uint32_t>(bond.a), b = first + static_cast<std::uint32_t>(bond.b);
    bodies.bonds.push_back(
        {a, b, bond.place - broken.pieces[bond.a].place, bond.normal, bond.area, settings.bondStrength});
    bodies.holds.push_back(1);
  }
}
}  // namespace

FracturedBody breakBody(const BodySettings& body, std::uint64_t seed) {
  FractureSettings fracture = body.fracture;
  fracture.seed = seed;
  return std::visit([&](const auto& shape) { return breakShape(shape, fracture, seed); }, body.shape);
}

std::string pieceName(const std::string& body, std::size_t piece, std::size_t pieces) {
  return pieces == 1 ? body : fmt::format("{}.{:03}", body, piece + 1);
}

std::vector<MovingSolid> makeBodies(const SimulationSettings& settings, WorldState& world) {
  std::vector<MovingSolid> solids;
  for (std::uint32_t number = 0; number < settings.bodies.size(); ++number) {
    const BodySettings& body = settings.bodies[number];
    const FracturedBody broken = breakBody(body, settings.seed);
    double volume = 0;
    for (const Piece& piece : broken.pieces) volume += piece.properties.volume;
    for (std::size_t n = 0; n < broken.pieces.size(); ++n) {
      const std::string name = pieceName(body.name, n, broken.pieces.size());
      addPiece(body, number, broken.pieces[n], name, massOf(broken.pieces[n], body.mass, volume), world);
      if (body.blocksGas)
        solids.push_back(
            {world.bodies.mesh.back(), {world.bodies.position.back(), world.bodies.orientation.back()}, {}, {}});
    }
    addBonds(body, broken, world.bodies);
  }
  return solids;
}

}  // namespace brisance
