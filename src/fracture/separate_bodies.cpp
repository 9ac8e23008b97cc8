#include "fracture/separate_bodies.h"

#include <map>
#include <numeric>

#include "fracture/solid_angle.h"
#include "mesh/disjoint_sets.h"
#include "mesh/mass_properties.h"

namespace brisance {
namespace {

/// Triangles of the surface that hang together.
struct Shell {
  std::vector<std::uint32_t> triangles;
  double volume = 0;
};

std::vector<Shell> shellsOf(const SolidSurface& surface) {
  DisjointSets sets(surface.places.size());
  for (const auto& [a, b, c] : surface.triangles) {
    sets.join(a, b);
    sets.join(a, c);
  }
  std::map<std::uint32_t, std::size_t> shellOf;
  std::vector<Shell> shells;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [place, isNew] = shellOf.try_emplace(sets.root(surface.triangles[t][0]), shells.size());
    if (isNew) shells.push_back({});
    Shell& shell = shells[place->second];
    shell.triangles.push_back(t);
    const Vec3d origin = surface.places[surface.triangles[shell.triangles[0]][0]];
    const auto& [a, b, c] = surface.triangles[t];
    shell.volume += dot(surface.places[a] - origin, cross(surface.places[b] - origin, surface.places[c] - origin)) / 6;
  }
  return shells;
}

bool surrounds(const SolidSurface& surface, const Shell& shell, const Vec3d& eye) {
  double angle = 0;
  for (const std::uint32_t t : shell.triangles) {
    const auto& [a, b, c] = surface.triangles[t];
    angle += solidAngle(surface.places[a] - eye, surface.places[b] - eye, surface.places[c] - eye);
  }
  return angle > 2 * pi;
}

/// The smallest body around a cavity; the cavity itself where there is none.
std::size_t ownerOf(const SolidSurface& surface, const std::vector<Shell>& shells, std::size_t cavity) {
  const Vec3d& eye = surface.places[surface.triangles[shells[cavity].triangles[0]][0]];
  std::size_t owner = cavity;
  for (std::size_t s = 0; s < shells.size(); ++s)
    if (shells[s].volume > 0 && (owner == cavity || shells[s].volume < shells[owner].volume) &&
        surrounds(surface, shells[s], eye))
      owner = s;
  return owner;
}

/// Some of the mesh's triangles with the vertices that they use.
TriangleMesh part(const TriangleMesh& mesh, const SolidSurface& surface, const std::vector<std::uint32_t>& triangles) {
  TriangleMesh result;
  std::vector<std::uint32_t> numberOf(mesh.vertices.size(), noVertex);
  for (const std::uint32_t t : triangles) {
    const std::uint32_t face = surface.faces[t];
    Triangle triangle = mesh.triangles[face];
    for (std::uint32_t& corner : triangle) {
      std::uint32_t& number = numberOf[corner];
      if (number == noVertex) {
        number = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[corner]);
        if (!mesh.normals.empty()) result.normals.push_back(mesh.normals[corner]);
        if (!mesh.uvs.empty()) result.uvs.push_back(mesh.uvs[corner]);
      }
      corner = number;
    }
    result.triangles.push_back(triangle);
    if (!mesh.materials.empty()) result.materials.push_back(mesh.materials[face]);
  }
  result.materialNames = mesh.materialNames;
  return result;
}

}  // namespace

std::vector<TriangleMesh> separateBodies(const TriangleMesh& mesh, const SolidSurface& surface) {
  const std::vector<Shell> shells = shellsOf(surface);
  std::vector<std::vector<std::uint32_t>> bodies(shells.size());
  for (std::size_t s = 0; s < shells.size(); ++s) {
    std::vector<std::uint32_t>& body = bodies[shells[s].volume > 0 ? s : ownerOf(surface, shells, s)];
    body.insert(body.end(), shells[s].triangles.begin(), shells[s].triangles.end());
  }
  std::vector<TriangleMesh> result;
  for (auto& body : bodies) {
    std::sort(body.begin(), body.end());
    if (!body.empty()) result.push_back(part(mesh, surface, body));
  }
  return result;
}

std::vector<int> piecesOfBodies(const std::vector<TriangleMesh>& bodies, int pieces) {
  std::vector<double> volume;
  volume.reserve(bodies.size());
  for (const TriangleMesh& body : bodies) volume.push_back(std::abs(solidProperties(body).volume));
  std::vector<int> share(bodies.size(), 1);
  // One after the other to the body whose pieces are largest.
  for (int given = static_cast<int>(bodies.size()); given < pieces; ++given) {
    std::size_t largest = 0;
    for (std::size_t b = 1; b < bodies.size(); ++b)
      if (volume[b] / share[b] > volume[largest] / share[largest]) largest = b;
    ++share[largest];
  }
  return share;
}

}  // namespace brisance
