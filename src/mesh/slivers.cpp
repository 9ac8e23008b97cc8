#include <algorithm>

#include "mesh/edge_uses.h"
#include "mesh/mesh_patient.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

constexpr int mostRounds = 8;  // slivers beside slivers wait for a later one

/// Turns the long sides of slivers, each round on triangles that have not changed in it.
class SliverTurning {
 public:
  explicit SliverTurning(Patient& patient) : patient_(patient) {}

  void run() {
    std::size_t before = 0;
    for (int round = 0; round < mostRounds; ++round) {
      const std::vector<std::uint32_t> slivers = find();
      if (slivers.empty() || (round > 0 && turned_.count + dropped_.count == before)) break;
      before = turned_.count + dropped_.count;
      treat(slivers);
    }
    Defect left;
    for (const std::uint32_t t : find()) patient_.count(left, t);
    patient_.note("triangles of no area given to their neighbours", turned_);
    patient_.note("triangles of no area dropped at an open edge", dropped_);
    patient_.note("triangles of no area kept, since the surface would open", left);
  }

 private:
  std::vector<std::uint32_t> find() const {
    std::vector<std::uint32_t> slivers;
    for (std::uint32_t t = 0; t < patient_.mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = patient_.mesh.triangles[t];
      if (isSliver(patient_.at(a), patient_.at(b), patient_.at(c))) slivers.push_back(t);
    }
    return slivers;
  }

  void treat(const std::vector<std::uint32_t>& slivers) {
    findNeighbours();
    std::vector<bool> keep(patient_.mesh.triangles.size(), true);
    for (const std::uint32_t t : slivers) {
      const std::uint32_t side = longSide(t), other = neighbours_[t][side];
      if (other == tangled || touched_[t]) continue;
      if (other == noTriangle) {
        keep[t] = false;
        patient_.count(dropped_, t);
        touch(t);
      } else if (!touched_[other] && mayTurn(t, side, other)) {
        patient_.count(turned_, t);
        touch(t);
        touch(other);
        turn(t, side, other);
      }
    }
    patient_.keepOnly(keep);
  }

  /// Also what lies around it now has another neighbour than neighbours_ says.
  void touch(std::uint32_t t) {
    touched_[t] = true;
    for (const std::uint32_t other : neighbours_[t])
      if (other < tangled) touched_[other] = true;
  }

  void findNeighbours() {
    const std::vector<Triangle> places = patient_.allPlaces();
    neighbours_.assign(places.size(), {noTriangle, noTriangle, noTriangle});
    touched_.assign(places.size(), false);
    forEachEdge(places, patient_.mesh.vertices.size(), [&](std::uint32_t, std::span<const EdgeUse> uses) {
      if (uses.size() == 1) return;
      for (const EdgeUse& use : uses) neighbours_[use.slot / 3][use.slot % 3] = tangled;
      if (uses.size() > 2) return;
      neighbours_[uses[0].slot / 3][uses[0].slot % 3] = uses[1].slot / 3;
      neighbours_[uses[1].slot / 3][uses[1].slot % 3] = uses[0].slot / 3;
    });
  }

  double squaredLength(std::uint32_t t, std::uint32_t side) const {
    const Triangle& v = patient_.mesh.triangles[t];
    const Vec3d edge = patient_.at(v[(side + 1) % 3]) - patient_.at(v[side]);
    return dot(edge, edge);
  }
  std::uint32_t longSide(std::uint32_t t) const {
    std::uint32_t longest = 0;
    for (const std::uint32_t side : {1u, 2u})
      if (squaredLength(t, side) > squaredLength(t, longest)) longest = side;
    return longest;
  }

  /// The side of `other` that it shares with side `side` of t.
  std::uint32_t sideOf(std::uint32_t t, std::uint32_t side, std::uint32_t other) const {
    const Triangle mine = patient_.places(t), theirs = patient_.places(other);
    for (std::uint32_t e = 0; e < 3; ++e) {
      const std::uint32_t p = theirs[e], q = theirs[(e + 1) % 3], a = mine[side], b = mine[(side + 1) % 3];
      if ((p == a && q == b) || (p == b && q == a)) return e;
    }
    return 0;
  }

  /// Not where that makes other slivers, or a second edge between the same two corners.
  bool mayTurn(std::uint32_t t, std::uint32_t side, std::uint32_t other) const {
    const std::uint32_t e = sideOf(t, side, other), middle = patient_.mesh.triangles[t][(side + 2) % 3];
    const Triangle& v = patient_.mesh.triangles[other];
    const Vec3d &p = patient_.at(v[e]), &q = patient_.at(v[(e + 1) % 3]), &far = patient_.at(v[(e + 2) % 3]);
    if (isSliver(p, patient_.at(middle), far) || isSliver(patient_.at(middle), q, far)) return false;
    const std::uint32_t farPlace = patient_.placeOf[v[(e + 2) % 3]];
    for (const std::uint32_t beside : neighbours_[t]) {
      if (beside >= tangled || beside == other) continue;
      const Triangle places = patient_.places(beside);
      if (std::find(places.begin(), places.end(), farPlace) != places.end()) return false;
    }
    return true;
  }

  void turn(std::uint32_t t, std::uint32_t side, std::uint32_t other) {
    const std::uint32_t e = sideOf(t, side, other), place = patient_.mesh.triangles[t][(side + 2) % 3];
    const Triangle v = patient_.mesh.triangles[other];
    const std::uint32_t p = v[e], q = v[(e + 1) % 3], far = v[(e + 2) % 3], middle = vertexBetween(place, p, q);
    patient_.mesh.triangles[t] = {p, middle, far};
    patient_.mesh.triangles[other] = {middle, q, far};
    patient_.source[t] = patient_.source[other];
    if (!patient_.mesh.materials.empty()) patient_.mesh.materials[t] = patient_.mesh.materials[other];
  }

  /// At the place of `vertex`, with the attributes that the side from p to q has there.
  std::uint32_t vertexBetween(std::uint32_t vertex, std::uint32_t p, std::uint32_t q) {
    TriangleMesh& mesh = patient_.mesh;
    if (mesh.normals.empty() && mesh.uvs.empty()) return vertex;
    const Vec3d whole = mesh.vertices[q] - mesh.vertices[p], part = mesh.vertices[vertex] - mesh.vertices[p];
    const double share = std::clamp(dot(part, whole) / dot(whole, whole), 0.0, 1.0);
    mesh.vertices.push_back(Vec3d(mesh.vertices[vertex]));
    if (!mesh.normals.empty())
      mesh.normals.push_back(normalized(mesh.normals[p] * (1 - share) + mesh.normals[q] * share));
    if (!mesh.uvs.empty()) mesh.uvs.push_back(mesh.uvs[p] * (1 - share) + mesh.uvs[q] * share);
    patient_.placeOf.push_back(patient_.placeOf[vertex]);
    return static_cast<std::uint32_t>(mesh.vertices.size()) - 1;
  }

  static constexpr std::uint32_t tangled = noTriangle - 1;  ///< an edge of more than two triangles
  Patient& patient_;
  std::vector<Triangle> neighbours_;
  std::vector<bool> touched_;
  Defect turned_, dropped_;
};

}  // namespace

void turnSlivers(Patient& patient) { SliverTurning(patient).run(); }

}  // namespace brisance
