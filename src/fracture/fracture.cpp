#include "fracture/fracture.h"

#include <map>

#include "base/check.h"
#include "fracture/partition.h"
#include "fracture/solid_fracture.h"
#include "mesh/extrusion.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

std::vector<std::vector<std::uint32_t>> trianglesByPiece(const Partition& partition) {
  std::vector<std::vector<std::uint32_t>> result(partition.count);
  for (std::uint32_t t = 0; t < partition.pieceOf.size(); ++t) result[partition.pieceOf[t]].push_back(t);
  return result;
}

/// Moves a piece to its own centroid and notes where that was.
Piece settled(TriangleMesh mesh, const MassProperties& properties) {
  Piece piece{std::move(mesh), properties, properties.centroid};
  recenter(piece.mesh, piece.place);
  piece.properties.centroid = {};
  return piece;
}

/// As long as the edge from a triangle's corner `edge` to the next; in the triangle's plane, away from it.
Vec3d outwardAcross(const TriangleMesh& mesh, std::uint32_t triangle, int edge) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3d &a = mesh.vertices[t[edge]], &b = mesh.vertices[t[(edge + 1) % 3]], &c = mesh.vertices[t[(edge + 2) % 3]];
  return cross(b - a, normalized(cross(b - a, c - a)));
}

double edgeLength(const TriangleMesh& mesh, std::uint32_t triangle, int edge) {
  const Triangle& t = mesh.triangles[triangle];
  return length(mesh.vertices[t[(edge + 1) % 3]] - mesh.vertices[t[edge]]);
}

Vec3d edgeMiddle(const TriangleMesh& mesh, std::uint32_t triangle, int edge) {
  const Triangle& t = mesh.triangles[triangle];
  return (mesh.vertices[t[edge]] + mesh.vertices[t[(edge + 1) % 3]]) / 2.0;
}

/// A shared border that closes on itself has no direction: then the one from centroid to centroid, else upwards.
Vec3d bondNormal(const Vec3d& sum, double sharedLength, const Vec3d& betweenCentroids) {
  constexpr double leastShare = 1e-6;  // of the sum's longest possible value: below it is rounding
  if (length(sum) > leastShare * sharedLength) return normalized(sum);
  if (length(betweenCentroids) > leastShare * sharedLength) return normalized(betweenCentroids);
  return {0, 1, 0};
}

struct SharedBorder {
  double length = 0;  ///< [m]
  Vec3d outwardSum;   ///< edge by edge, from the lower piece [m]
  Vec3d moment;       ///< middles of edges times their lengths [m2]
};

/// Bonds across all edges between pieces of a cut mesh whose cut faces are `depth` [m] high, ordered by a, then b.
std::vector<Bond> bondsBetween(const TriangleMesh& mesh, const Partition& partition, const std::vector<Piece>& pieces,
                               double depth) {
  std::map<std::pair<int, int>, SharedBorder> borders;
  const std::vector<Triangle> neighbours = edgeNeighbours(mesh);
  for (std::uint32_t t = 0; t < neighbours.size(); ++t)
    for (int edge = 0; edge < 3; ++edge) {
      const std::uint32_t other = neighbours[t][edge];
      if (other == noTriangle || partition.pieceOf[t] == partition.pieceOf[other]) continue;
      const bool lower = partition.pieceOf[t] < partition.pieceOf[other];
      SharedBorder& border = borders[std::minmax(partition.pieceOf[t], partition.pieceOf[other])];
      // Each edge is met twice, from both sides: half its length, and half of each side's outward direction.
      const double half = edgeLength(mesh, t, edge) / 2;
      border.length += half;
      border.moment += edgeMiddle(mesh, t, edge) * half;
      border.outwardSum += outwardAcross(mesh, t, edge) * (lower ? 0.5 : -0.5);
    }
  std::vector<Bond> bonds;
  for (const auto& [pair, border] : borders) {
    const Vec3d between = pieces[pair.second].place - pieces[pair.first].place;
    bonds.push_back({pair.first, pair.second, border.length * depth,
                     bondNormal(border.outwardSum, border.length, between), border.moment / border.length});
  }
  return bonds;
}

TriangleMesh flatSurface(const FlatMesh& flat) {
  TriangleMesh mesh;
  for (const Vec2d& p : flat.points) mesh.vertices.push_back({p.x, p.y, 0});
  mesh.triangles = flat.triangles;
  return mesh;
}

/// Some triangles of a mesh, with the vertices they use in their old order.
TriangleMesh subset(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  std::vector<std::uint32_t> used;
  for (const std::uint32_t t : triangles) used.insert(used.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  TriangleMesh part;
  for (const std::uint32_t v : used) {
    part.vertices.push_back(mesh.vertices[v]);
    if (!mesh.normals.empty()) part.normals.push_back(mesh.normals[v]);
    if (!mesh.uvs.empty()) part.uvs.push_back(mesh.uvs[v]);
  }
  const auto local = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
  };
  for (const std::uint32_t t : triangles) {
    const auto& [a, b, c] = mesh.triangles[t];
    part.triangles.push_back({local(a), local(b), local(c)});
    if (!mesh.materials.empty()) part.materials.push_back(mesh.materials[t]);
  }
  part.materialNames = mesh.materialNames;
  return part;
}

/// What a mesh bounds, whatever doubling of vertices its normals and uvs ask for.
TriangleMesh surfaceOf(const TriangleMesh& mesh) { return isClosed(mesh) ? mesh : welded(mesh); }

/// A closed mesh is solid inside, and turned right side out where its triangles face inwards. Anything else is a shell.
Piece wholePiece(TriangleMesh mesh, double shellThickness) {
  if (!isClosed(surfaceOf(mesh))) {
    const MassProperties properties = shellProperties(mesh, shellThickness);
    return settled(std::move(mesh), properties);
  }
  if (solidProperties(mesh).volume < 0) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    for (Vec3d& normal : mesh.normals) normal = -normal;
  }
  const MassProperties properties = solidProperties(mesh);
  return settled(std::move(mesh), properties);
}

void recordCut(const Cut& cut, FracturedBody& body) {
  body.eigenvalues = cut.eigenvalues;
  body.graphSeconds = cut.graphSeconds;
  body.partitionSeconds = cut.partitionSeconds;
}

}  // namespace

CutLine cutLine(const TriangleMesh& mesh, const std::vector<int>& pieceOfTriangle) {
  CutLine line;
  const std::vector<Triangle> neighbours = edgeNeighbours(surfaceOf(mesh));
  for (std::uint32_t t = 0; t < neighbours.size(); ++t)
    for (int edge = 0; edge < 3; ++edge) {
      const std::uint32_t other = neighbours[t][edge];
      if (other == noTriangle || other < t || pieceOfTriangle[t] == pieceOfTriangle[other]) continue;
      ++line.edges;
      line.length += edgeLength(mesh, t, edge);
    }
  return line;
}

FracturedBody fracturePane(const PaneSettings& pane, const FractureSettings& fracture, std::uint64_t seed) {
  const PanePoints points = placePoints(pane.outline, pane.pattern, pane.points, seed);
  const FlatMesh flat = triangulatePane(points, pane.triangulation, seed);
  const TriangleMesh sheet = flatSurface(flat);
  const Cut cut = partitionSurface(sheet, fracture);
  FracturedBody body;
  body.solid = true;
  for (const auto& triangles : trianglesByPiece(cut.partition)) {
    TriangleMesh solid = extrude(flat, triangles, pane.thickness);
    const MassProperties properties = solidProperties(solid);
    body.pieces.push_back(settled(std::move(solid), properties));
  }
  body.bonds = bondsBetween(sheet, cut.partition, body.pieces, pane.thickness);
  recordCut(cut, body);
  return body;
}

FracturedBody fractureMesh(const TriangleMesh& mesh, const FractureSettings& fracture, double shellThickness) {
  if (fracture.solid.enabled) return fractureSolid(mesh, fracture);
  FracturedBody body;
  if (fracture.pieces == 1) {
    body.pieces.push_back(wholePiece(mesh, shellThickness));
    body.pieceOfTriangle.assign(mesh.triangles.size(), 0);
    return body;
  }
  const TriangleMesh surface = surfaceOf(mesh);
  Cut cut = partitionSurface(surface, fracture);
  for (const auto& triangles : trianglesByPiece(cut.partition)) {
    TriangleMesh shell = subset(mesh, triangles);
    const MassProperties properties = shellProperties(shell, shellThickness);
    body.pieces.push_back(settled(std::move(shell), properties));
  }
  body.bonds = bondsBetween(surface, cut.partition, body.pieces, shellThickness);
  recordCut(cut, body);
  body.pieceOfTriangle = std::move(cut.partition.pieceOf);
  return body;
}

}  // namespace brisance
