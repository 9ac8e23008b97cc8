#include "mesh/mesh_repair.h"

#include "base/check.h"
#include "mesh/disjoint_sets.h"
#include "mesh/mass_properties.h"
#include "mesh/mesh_patient.h"
#include "mesh/mesh_topology.h"
#include "mesh/nesting.h"

namespace brisance {
namespace {

Patient admit(const TriangleMesh& mesh, const RepairSettings& settings) {
  Patient patient{mesh, samePlaces(mesh.vertices), {}, {}};
  patient.source.resize(mesh.triangles.size());
  std::iota(patient.source.begin(), patient.source.end(), 0u);
  if (settings.weldDistance > 0) weldClose(patient, settings.weldDistance);
  return patient;
}

/// Per triangle of the input its part, connected across edges between places.
DisjointSets partsOf(const Patient& patient) {
  DisjointSets parts(patient.mesh.triangles.size());
  const std::vector<Triangle> neighbours = edgeNeighbours(patient.allPlaces(), patient.mesh.vertices.size());
  for (std::uint32_t t = 0; t < neighbours.size(); ++t)
    for (const std::uint32_t other : neighbours[t])
      if (other != noTriangle) parts.join(t, other);
  return parts;
}

/// A part of which no triangle is left shall not go in silence.
void nameLostParts(Patient& patient, DisjointSets& parts, const Patient& before) {
  std::vector<bool> lives(before.mesh.triangles.size());
  for (const std::uint32_t t : patient.source)
    if (t != noTriangle) lives[parts.root(t)] = true;
  Defect lost;
  for (std::uint32_t t = 0; t < lives.size(); ++t)
    if (parts.root(t) == t && !lives[t]) lost.note(before.centre(t), t);
  patient.note("parts lost, of which no triangle bounds anything", lost);
}

/// Joins the corners around each vertex that are connected by neighbours.
DisjointSets fansOf(const std::vector<Triangle>& places, const std::vector<Triangle>& neighbours) {
  DisjointSets fans(3 * places.size());
  const auto cornerAt = [&](std::uint32_t t, std::uint32_t place) {
    return 3 * t + static_cast<std::uint32_t>(std::find(places[t].begin(), places[t].end(), place) - places[t].begin());
  };
  for (std::uint32_t t = 0; t < places.size(); ++t)
    for (std::uint32_t e = 0; e < 3; ++e) {
      const std::uint32_t other = neighbours[t][e], next = (e + 1) % 3;
      if (other == noTriangle) continue;
      fans.join(3 * t + e, cornerAt(other, places[t][e]));
      fans.join(3 * t + next, cornerAt(other, places[t][next]));
    }
  return fans;
}

/// Per triangle the number of its part if that is closed, else noTriangle; and each such part's first triangle.
struct ClosedParts {
  std::vector<std::uint32_t> partOf, first;
};

ClosedParts closedParts(const std::vector<Triangle>& neighbours) {
  const auto count = static_cast<std::uint32_t>(neighbours.size());
  DisjointSets parts(count);
  for (std::uint32_t t = 0; t < count; ++t)
    for (const std::uint32_t other : neighbours[t])
      if (other != noTriangle) parts.join(t, other);
  std::vector<bool> isOpen(count, false);
  for (std::uint32_t t = 0; t < count; ++t)
    for (const std::uint32_t other : neighbours[t])
      if (other == noTriangle) isOpen[parts.root(t)] = true;
  ClosedParts closed{std::vector<std::uint32_t>(count, noTriangle), {}};
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::uint32_t root = parts.root(t);
    if (isOpen[root]) continue;
    if (root == t) closed.first.push_back(t);
    closed.partOf[t] = root == t ? static_cast<std::uint32_t>(closed.first.size()) - 1 : closed.partOf[root];
  }
  return closed;
}

/// Turns closed parts outward, and those inside others inward.
void turnParts(Patient& patient, Sheets& sheets) {
  const ClosedParts parts = closedParts(sheets.neighbours);
  const Turning turning = turningOf(patient.mesh, parts.partOf, parts.first.size());
  Defect outward, inward;
  for (std::size_t part = 0; part < parts.first.size(); ++part)
    if (turning.turn[part]) patient.count(turning.inside[part] ? inward : outward, parts.first[part]);
  for (std::uint32_t t = 0; t < parts.partOf.size(); ++t)
    if (parts.partOf[t] != noTriangle && turning.turn[parts.partOf[t]]) sheets.turnOver(patient, t);
  patient.note("parts turned outward", outward);
  patient.note("parts inside another turned inward, as cavities", inward);
  if (!turning.judged)
    patient.done.emplace_back("too many parts overlap to tell which lie inside which: none is taken for a cavity");
}

/// Gives each fan a vertex of the surface, and each vertex with attributes a copy for each of its fans.
class Discharge {
 public:
  Discharge(Patient& patient, std::vector<std::uint32_t> fanOf)
      : patient_(patient), fanOf_(std::move(fanOf)), number_(patient.mesh.vertices.size(), noTriangle) {}

  RepairedMesh run() {
    collectVertices();
    renumber();
    RepairedMesh repaired;
    numberSurface(repaired);
    repaired.sourceTriangle = std::move(patient_.source);
    repaired.done = std::move(patient_.done);
    repaired.mesh = std::move(result_);
    return repaired;
  }

 private:
  struct Copy {
    std::uint32_t vertex = 0, fan = 0;
  };

  /// The vertices in use, in their order; then copies for further fans.
  void collectVertices() {
    const TriangleMesh& mesh = patient_.mesh;
    std::vector<std::uint32_t> firstFan(mesh.vertices.size(), noTriangle);
    for (std::uint32_t corner = 0; corner < fanOf_.size(); ++corner) {
      std::uint32_t& fan = firstFan[mesh.triangles[corner / 3][corner % 3]];
      if (fan == noTriangle) fan = fanOf_[corner];
    }
    for (std::uint32_t v = 0; v < firstFan.size(); ++v) {
      if (firstFan[v] == noTriangle) continue;
      number_[v] = static_cast<std::uint32_t>(copies_.size());
      copies_.push_back({v, firstFan[v]});
    }
  }

  void renumber() {
    TriangleMesh& mesh = patient_.mesh;
    std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>> further;  // (vertex, fan), corner
    for (std::uint32_t corner = 0; corner < fanOf_.size(); ++corner) {
      std::uint32_t& vertex = mesh.triangles[corner / 3][corner % 3];
      if (copies_[number_[vertex]].fan == fanOf_[corner])
        vertex = number_[vertex];
      else
        further.push_back({{vertex, fanOf_[corner]}, corner});
    }
    std::sort(further.begin(), further.end());
    for (std::size_t i = 0; i < further.size(); ++i) {
      const auto& [key, corner] = further[i];
      if (i == 0 || key != further[i - 1].first) copies_.push_back({key.first, key.second});
      mesh.triangles[corner / 3][corner % 3] = static_cast<std::uint32_t>(copies_.size()) - 1;
    }
    result_.triangles = std::move(mesh.triangles);
    result_.materials = std::move(mesh.materials);
    result_.materialNames = std::move(mesh.materialNames);
    for (const Copy& copy : copies_) {
      result_.vertices.push_back(mesh.vertices[copy.vertex]);
      if (!mesh.normals.empty()) result_.normals.push_back(mesh.normals[copy.vertex]);
      if (!mesh.uvs.empty()) result_.uvs.push_back(mesh.uvs[copy.vertex]);
    }
  }

  void numberSurface(RepairedMesh& repaired) {
    std::vector<std::uint32_t> numberOfFan(fanOf_.size(), noTriangle), fansAt(patient_.placeOf.size(), 0);
    Defect split;
    for (const Copy& copy : copies_) {
      std::uint32_t& number = numberOfFan[copy.fan];
      if (number == noTriangle) {
        number = static_cast<std::uint32_t>(repaired.surfaceVertices++);
        const std::uint32_t place = patient_.placeOf[copy.vertex];
        if (++fansAt[place] == 2)
          split.note(result_.vertices[repaired.surfaceVertexOf.size()], patient_.source[copy.fan / 3]);
      }
      repaired.surfaceVertexOf.push_back(number);
    }
    patient_.note("vertices taken apart where fans of triangles only touch", split);
  }

  Patient& patient_;
  std::vector<std::uint32_t> fanOf_;   ///< per corner
  std::vector<std::uint32_t> number_;  ///< in the result, of each vertex's first copy
  std::vector<Copy> copies_;           ///< the result's vertices
  TriangleMesh result_;
};

void nameUnusedVertices(Patient& patient) {
  std::vector<bool> used(patient.mesh.vertices.size());
  for (const Triangle& t : patient.mesh.triangles)
    for (const std::uint32_t v : t) used[v] = true;
  const auto count = std::count(used.begin(), used.end(), false);
  if (count > 0) patient.done.push_back(fmt::format("vertices left out that no triangle uses: {}", count));
}

std::vector<std::uint32_t> rootsOf(DisjointSets& sets, std::size_t count) {
  std::vector<std::uint32_t> roots(count);
  for (std::uint32_t n = 0; n < count; ++n) roots[n] = sets.root(n);
  return roots;
}

}  // namespace

RepairedMesh repair(const TriangleMesh& mesh, const RepairSettings& settings) {
  Patient patient = admit(mesh, settings);
  const Patient before = patient;
  DisjointSets parts = partsOf(patient);
  dropRepeatedCorners(patient);
  dropDuplicates(patient);
  turnSlivers(patient);
  nameLostParts(patient, parts, before);
  Sheets sheets = orient(patient);
  if (settings.fillHolesUpTo > 0 && sheets.openEdges.count > 0 && fillHoles(patient, settings.fillHolesUpTo))
    sheets = orient(patient);
  turnParts(patient, sheets);
  DisjointSets fans = fansOf(patient.allPlaces(), sheets.neighbours);
  const std::vector<std::uint32_t> fanOf = rootsOf(fans, 3 * patient.mesh.triangles.size());
  nameUnusedVertices(patient);
  RepairedMesh repaired = Discharge(patient, fanOf).run();
  repaired.openEdges = sheets.openEdges;
  repaired.tangledEdges = sheets.tangledEdges;
  repaired.twistedEdges = sheets.twistedEdges;
  return repaired;
}

TriangleMesh bareSurface(const RepairedMesh& repaired) {
  TriangleMesh surface;
  surface.vertices.resize(repaired.surfaceVertices);
  for (std::size_t v = 0; v < repaired.surfaceVertexOf.size(); ++v)
    surface.vertices[repaired.surfaceVertexOf[v]] = repaired.mesh.vertices[v];
  for (const auto& [a, b, c] : repaired.mesh.triangles)
    surface.triangles.push_back(
        {repaired.surfaceVertexOf[a], repaired.surfaceVertexOf[b], repaired.surfaceVertexOf[c]});
  return surface;
}

void requireSolid(const RepairedMesh& repaired, const std::string& file) {
  const auto refuse = [&](const std::string& trouble) {
    throw DamagedFile(fmt::format("{}: {}; a solid needs a closed surface", file, trouble));
  };
  if (repaired.mesh.triangles.empty()) refuse("no triangle that bounds anything");
  if (repaired.tangledEdges.count > 0)
    refuse("edges of several sheets that cannot be told apart: " + textOf(repaired.tangledEdges));
  if (repaired.openEdges.count > 0) refuse("open edges: " + textOf(repaired.openEdges));
  if (repaired.twistedEdges.count > 0)
    refuse("edges where the surface has but one side: " + textOf(repaired.twistedEdges));
  if (!(solidProperties(repaired.mesh).volume > 0)) refuse("no volume inside");
}

}  // namespace brisance
