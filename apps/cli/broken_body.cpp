#include "broken_body.h"

#include "base/check.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_repair.h"
#include "mesh/mesh_topology.h"
#include "scene/scene_file.h"
#include "simulation/make_bodies.h"

namespace brisance {
namespace {

/// Moves points to a lattice whose nodes 32-bit floats hold exactly, as far as the pieces reach: a node minus another
/// one is a node again, so a corner about its piece's centroid and the centroid add up to the same place for both of
/// the pieces that share it.
class FloatLattice {
 public:
  explicit FloatLattice(const std::vector<Piece>& pieces) {
    double reach = 0;
    for (const Piece& piece : pieces)
      for (const Vec3d& v : piece.mesh.vertices) {
        const Vec3d place = v + piece.place;
        reach = std::max({reach, std::abs(place.x), std::abs(place.y), std::abs(place.z)});
      }
    // Twice the reach must fit into the 24 bits of a float's significand.
    step_ = std::ldexp(1.0, std::ilogb(std::max(reach, 1e-30)) + 2 - std::numeric_limits<float>::digits);
  }
  Vec3d operator()(const Vec3d& p) const { return {nearest(p.x), nearest(p.y), nearest(p.z)}; }

 private:
  double nearest(double x) const { return std::nearbyint(x / step_) * step_; }
  double step_;
};

FrameBody atRest(const BrokenBody& body, const Piece& piece, const std::string& name, const FloatLattice& lattice) {
  const Vec3d place = lattice(piece.place);
  auto mesh = std::make_shared<TriangleMesh>(piece.mesh);
  for (Vec3d& v : mesh->vertices) v = lattice(v + piece.place) - place;
  FrameBody rest;
  rest.name = name;
  rest.mesh = std::move(mesh);
  rest.material = body.material;
  rest.pose = {body.pose * place, body.pose.orientation};
  return rest;
}

void mend(const Options& options, BrokenBody& body) {
  RepairedMesh repaired = repair(body.input);
  if (body.settings.solid.enabled) requireSolid(repaired, options.path);
  body.input = std::move(repaired.mesh);
  body.repairs = std::move(repaired.done);
}

}  // namespace

BrokenBody breakMeshFile(const Options& options) {
  BrokenBody body;
  body.name = options.path.stem();
  body.settings = options.fracture.settings;
  body.material = "outside";
  const Stopwatch reading;
  body.input = readMesh(options.path);
  body.inputClosed = isClosed(welded(body.input));
  if (body.settings.solid.enabled || options.fracture.repair) mend(options, body);
  body.readSeconds = reading.seconds();
  const Stopwatch breaking;
  constexpr double shellThickness = 0.01;  // [m] for the inertia of open pieces
  body.broken = fractureMesh(body.input, body.settings, shellThickness);
  body.breakSeconds = breaking.seconds();
  return body;
}

std::vector<BrokenBody> breakScene(const Options& options) {
  if (options.fracture.givenForMesh)
    throw InputError(
        "brisance: a scene says itself how its bodies break; change it with --set bodies.NAME.fracture.KEY=VALUE");
  if (!options.fracture.labels.empty()) throw InputError("brisance: --labels: belongs to a mesh, not to a scene");
  const Stopwatch reading;
  const Scene scene = readScene(options.path, options.overrides);
  const double readSeconds = reading.seconds();
  std::vector<BrokenBody> bodies;
  for (const BodySettings& settings : scene.simulation.bodies) {
    if (!settings.moves) continue;
    BrokenBody body;
    body.name = settings.name;
    body.settings = settings.fracture;
    body.pose = settings.pose;
    body.material = settings.material;
    const Stopwatch breaking;
    body.broken = breakBody(settings, scene.simulation.seed);
    body.breakSeconds = breaking.seconds();
    bodies.push_back(std::move(body));
  }
  if (bodies.empty()) throw InputError(fmt::format("{}: no body that moves, so nothing breaks", options.path.string()));
  bodies.front().readSeconds = readSeconds;
  return bodies;
}

std::vector<FrameBody> piecesAtRest(const std::vector<BrokenBody>& bodies) {
  std::vector<FrameBody> pieces;
  for (const BrokenBody& body : bodies) {
    const FloatLattice lattice(body.broken.pieces);
    for (std::size_t n = 0; n < body.broken.pieces.size(); ++n)
      pieces.push_back(
          atRest(body, body.broken.pieces[n], pieceName(body.name, n, body.broken.pieces.size()), lattice));
  }
  return pieces;
}

}  // namespace brisance
