#include "mesh/mesh_report.h"

#include "base/check.h"
#include "mesh/disjoint_sets.h"
#include "mesh/edge_uses.h"
#include "mesh/mass_properties.h"
#include "mesh/mesh_topology.h"
#include "mesh/nesting.h"
#include "mesh/number_table.h"

namespace brisance {
namespace {

constexpr double noHeight = 1e-12;  // of the longest side: rounding makes as much of three points on a line

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Looks at the welded surface from all sides.
class Examination {
 public:
  explicit Examination(const TriangleMesh& mesh) : mesh_(mesh), surface_(welded(mesh)) {
    report_.vertices = mesh.vertices.size();
    report_.triangles = mesh.triangles.size();
    report_.hasNormals = !mesh.normals.empty();
    report_.hasUvs = !mesh.uvs.empty();
    report_.materialNames = mesh.materialNames;
  }

  MeshReport run() {
    countVertices();
    dropRepeated();
    findSlivers();
    findDuplicates();
    lookAtEdges();
    measure();
    return std::move(report_);
  }

 private:
  const Vec3d& at(std::uint32_t vertex) const { return surface_.vertices[vertex]; }
  Vec3d centre(const Triangle& t) const { return (at(t[0]) + at(t[1]) + at(t[2])) / 3.0; }

  void countVertices() {
    std::vector<bool> named(mesh_.vertices.size()), place(mesh_.vertices.size());
    for (const Triangle& t : mesh_.triangles)
      for (const std::uint32_t v : t) named[v] = true;
    for (const Triangle& t : surface_.triangles)
      for (const std::uint32_t v : t) {
        place[v] = true;
        report_.box.include(at(v));
      }
    report_.unusedVertices = static_cast<std::size_t>(std::count(named.begin(), named.end(), false));
    report_.places = static_cast<std::size_t>(std::count(place.begin(), place.end(), true));
  }

  void dropRepeated() {
    std::vector<Triangle> kept;
    for (std::uint32_t n = 0; n < surface_.triangles.size(); ++n) {
      const auto& [a, b, c] = surface_.triangles[n];
      if (a == b || b == c || c == a) {
        report_.repeated.note(at(a), n);
      } else {
        kept.push_back(surface_.triangles[n]);
        numberOf_.push_back(n);
      }
    }
    surface_.triangles = std::move(kept);
  }

  void findSlivers() {
    for (std::uint32_t n = 0; n < surface_.triangles.size(); ++n) {
      const Triangle& t = surface_.triangles[n];
      if (isSliver(at(t[0]), at(t[1]), at(t[2]))) report_.slivers.note(centre(t), numberOf_[n]);
    }
  }

  void findDuplicates() {
    NumberTable table(surface_.triangles.size());
    for (std::uint32_t n = 0; n < surface_.triangles.size(); ++n) {
      const Triangle t = sorted(surface_.triangles[n]);
      const std::uint32_t first = table.findOrAdd(mixHash(mixHash(t[0], t[1]), t[2]), n, [&](std::uint32_t other) {
        return sorted(surface_.triangles[other]) == t;
      });
      if (first != n) report_.duplicates.note(centre(t), numberOf_[n]);
    }
  }

  void lookAtEdges() {
    const std::vector<Triangle>& triangles = surface_.triangles;
    DisjointSets parts(triangles.size()), fans(3 * triangles.size());
    std::vector<bool> partIsClosed(triangles.size(), true);
    std::vector<EdgeUse> open;
    std::size_t edges = 0;
    std::vector<std::uint32_t> unclosed;  // triangles at edges that keep their part from being closed
    forEachEdge(triangles, surface_.vertices.size(), [&](std::uint32_t low, std::span<const EdgeUse> uses) {
      ++edges;
      for (std::size_t i = 1; i < uses.size(); ++i) {
        parts.join(uses[i - 1].slot / 3, uses[i].slot / 3);
        fans.join(lowCorner(uses[i - 1]), lowCorner(uses[i]));
        fans.join(highCorner(uses[i - 1]), highCorner(uses[i]));
      }
      if (judgeEdge(low, uses)) return;
      unclosed.push_back(uses[0].slot / 3);
      if (uses.size() == 1) open.push_back(uses[0]);
    });
    for (const std::uint32_t t : unclosed) partIsClosed[parts.root(t)] = false;
    report_.closed = unclosed.empty() && !triangles.empty();
    report_.euler = static_cast<std::int64_t>(report_.places + triangles.size()) - static_cast<std::int64_t>(edges);
    countHoles(open, fans);
    const std::int64_t split = countFans(fans);
    judgeParts(parts, partIsClosed);
    if (report_.closed) report_.genus = static_cast<std::int64_t>(report_.parts) - (report_.euler + split) / 2;
  }

  /// Whether the edge is used once each way.
  bool judgeEdge(std::uint32_t low, std::span<const EdgeUse> uses) {
    const Vec3d middle = (at(low) + at(uses[0].high)) * 0.5;
    const std::uint32_t triangle = numberOf_[uses[0].slot / 3];
    if (uses.size() > 2) report_.tangledEdges.note(middle, triangle);
    const bool flipped = uses.size() == 2 && uses[0].rising == uses[1].rising;
    if (flipped) report_.flippedEdges.note(middle, triangle);
    return uses.size() == 2 && !flipped;
  }

  /// Open edges that share a fan of triangles at their ends follow each other around one hole.
  void countHoles(const std::vector<EdgeUse>& open, DisjointSets& fans) {
    report_.openEdges = open.size();
    DisjointSets loops(3 * surface_.triangles.size());
    for (const EdgeUse& use : open) loops.join(fans.root(lowCorner(use)), fans.root(highCorner(use)));
    std::vector<bool> seen(3 * surface_.triangles.size());
    for (const EdgeUse& use : open) {
      const std::uint32_t loop = loops.root(fans.root(lowCorner(use)));
      if (seen[loop]) continue;
      seen[loop] = true;
      const std::uint32_t low = surface_.triangles[use.slot / 3][lowCorner(use) % 3];
      report_.holes.note((at(low) + at(use.high)) * 0.5, numberOf_[use.slot / 3]);
    }
  }

  /// Fans beyond the first at each place.
  std::int64_t countFans(DisjointSets& fans) {
    std::vector<std::uint32_t> count(surface_.vertices.size(), 0);
    std::int64_t further = 0;
    for (std::uint32_t corner = 0; corner < 3 * surface_.triangles.size(); ++corner) {
      if (fans.root(corner) != corner) continue;
      const std::uint32_t vertex = surface_.triangles[corner / 3][corner % 3];
      if (++count[vertex] == 2) report_.pinched.note(at(vertex), numberOf_[corner / 3]);
      further += count[vertex] > 1;
    }
    return further;
  }

  void judgeParts(DisjointSets& parts, const std::vector<bool>& partIsClosed) {
    std::vector<std::uint32_t> number(surface_.triangles.size(), noTriangle), partOf, first;
    for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
      const std::uint32_t root = parts.root(t);
      report_.parts += root == t;
      if (partIsClosed[root] && root == t) {
        number[t] = static_cast<std::uint32_t>(first.size());
        first.push_back(t);
      }
      partOf.push_back(number[root]);
    }
    const Turning turning = turningOf(surface_, partOf, first.size());
    report_.nestingJudged = turning.judged;
    for (std::size_t part = 0; part < first.size(); ++part)
      if (turning.turn[part]) report_.insideOut.note(centre(surface_.triangles[first[part]]), numberOf_[first[part]]);
  }

  void measure() {
    const MassProperties properties = solidProperties(surface_);
    report_.area = properties.area;
    report_.volume = report_.closed ? properties.volume : 0;
    report_.crossing = selfCrossing(surface_);
    if (report_.crossing.pairs == 0) return;
    const std::uint32_t first = report_.crossing.triangle;
    report_.crossingAt = centre(surface_.triangles[first]);
    report_.crossing.triangle = numberOf_[first];
  }

  const TriangleMesh& mesh_;
  TriangleMesh surface_;
  std::vector<std::uint32_t> numberOf_;  ///< in the mesh, of each triangle that was kept
  MeshReport report_;
};

}  // namespace

void Defect::note(const Vec3d& place, std::uint32_t number) {
  if (count++ > 0) return;
  at = place;
  triangle = number;
}

std::string textOf(const Defect& defect) {
  const std::string text =
      fmt::format("{}, the first at ({:.6g}, {:.6g}, {:.6g})", defect.count, defect.at.x, defect.at.y, defect.at.z);
  return defect.triangle == noTriangle ? text : text + fmt::format(", triangle {}", defect.triangle + std::uint64_t{1});
}

bool isSliver(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d u = b - a, v = c - a, w = c - b;
  const double longest = std::max({dot(u, u), dot(v, v), dot(w, w)});
  return length(cross(u, v)) <= noHeight * longest;
}

bool MeshReport::isSound() const {
  return closed && pinched.count == 0 && repeated.count == 0 && slivers.count == 0 && duplicates.count == 0 &&
         insideOut.count == 0 && nestingJudged && crossing.pairs == 0;
}

MeshReport examine(const TriangleMesh& mesh) { return Examination(mesh).run(); }

}  // namespace brisance
