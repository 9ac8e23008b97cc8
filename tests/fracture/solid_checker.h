// Judges solid pieces from their triangles alone, by a way of its own: nothing here calls what makes or measures them.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fracture/fracture.h"

namespace brisance::solid_checker {

using Place = std::array<double, 3>;
using PlaceTriangle = std::array<Place, 3>;

inline Place placeOf(const Vec3d& p) { return {p.x, p.y, p.z}; }

/// Triangles by the places of their corners in the body's coordinates.
inline std::vector<PlaceTriangle> trianglesOf(const Piece& piece) {
  std::vector<PlaceTriangle> result;
  for (const Triangle& t : piece.mesh.triangles) {
    PlaceTriangle places;
    for (int k = 0; k < 3; ++k) places[k] = placeOf(piece.mesh.vertices[t[k]] + piece.place);
    result.push_back(places);
  }
  return result;
}

/// The places as numbers, equal where the places are exactly equal.
inline std::vector<std::array<int, 3>> numbered(const std::vector<PlaceTriangle>& triangles) {
  std::vector<Place> places;
  for (const PlaceTriangle& t : triangles) places.insert(places.end(), t.begin(), t.end());
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<std::array<int, 3>> result;
  for (const PlaceTriangle& t : triangles) {
    std::array<int, 3> numbers{};
    for (int k = 0; k < 3; ++k)
      numbers[k] = static_cast<int>(std::lower_bound(places.begin(), places.end(), t[k]) - places.begin());
    result.push_back(numbers);
  }
  return result;
}

/// Every directed edge once and its reverse once.
inline std::string edgeFault(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<std::pair<int, int>> edges;
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) edges.push_back({t[k], t[(k + 1) % 3]});
  std::sort(edges.begin(), edges.end());
  for (std::size_t n = 0; n < edges.size(); ++n) {
    const auto [a, b] = edges[n];
    if (a == b) return "an edge of no length";
    if (n > 0 && edges[n] == edges[n - 1]) return "an edge twice in one direction";
    if (!std::binary_search(edges.begin(), edges.end(), std::pair(b, a))) return "an open edge";
  }
  return "";
}

/// The triangles around each vertex are one ring: following their far sides from vertex to vertex comes round to all.
inline std::string fanFault(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<std::array<int, 3>> sides;  // vertex, and the far side from .. to
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) sides.push_back({t[k], t[(k + 1) % 3], t[(k + 2) % 3]});
  std::sort(sides.begin(), sides.end());
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end = std::find_if(begin, sides.end(), [&](const auto& s) { return s[0] != (*begin)[0]; });
    int at = (*begin)[1];
    for (auto step = begin; step != end; ++step) {
      const auto next = std::lower_bound(begin, end, std::array<int, 3>{(*begin)[0], at, -1});
      if (next == end || (*next)[1] != at) return "a vertex with an open fan";
      at = (*next)[2];
      if (at == (*begin)[1] && step + 1 != end) return "a vertex with several fans";
    }
    begin = end;
  }
  return "";
}

/// By the divergence theorem: the sum of x n_x over the triangles, about one of the places.
inline double volumeOf(const std::vector<PlaceTriangle>& triangles) {
  if (triangles.empty()) return 0;
  const Place origin = triangles[0][0];
  long double sum = 0;
  for (const PlaceTriangle& t : triangles) {
    const auto at = [&](int k, int axis) { return static_cast<long double>(t[k][axis]) - origin[axis]; };
    const long double normalX =
        (at(1, 1) - at(0, 1)) * (at(2, 2) - at(0, 2)) - (at(1, 2) - at(0, 2)) * (at(2, 1) - at(0, 1));
    sum += (at(0, 0) + at(1, 0) + at(2, 0)) / 6 * normalX;
  }
  return static_cast<double>(sum);
}

inline double volumeOf(const TriangleMesh& mesh) {
  Piece piece;
  piece.mesh = mesh;
  return volumeOf(trianglesOf(piece));
}

/// A triangle with its least corner first, so that rotations compare equal.
inline PlaceTriangle rotatedToLeast(PlaceTriangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// Every inside face of every piece is the reverse of exactly one other piece's.
inline std::string sharingFault(const FracturedBody& body) {
  std::map<PlaceTriangle, int> open;  // times a triangle waits for its reverse
  for (const Piece& piece : body.pieces) {
    const auto triangles = trianglesOf(piece);
    const std::vector<std::string>& names = piece.mesh.materialNames;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (names.at(piece.mesh.materials.at(t)) != "inside") continue;
      const PlaceTriangle here = rotatedToLeast(triangles[t]);
      const PlaceTriangle reverse = rotatedToLeast({here[0], here[2], here[1]});
      if (auto waiting = open.find(reverse); waiting != open.end()) {
        if (--waiting->second == 0) open.erase(waiting);
      } else {
        ++open[here];
      }
    }
  }
  return open.empty() ? "" : "an inside face that no other piece shares";
}

/// Empty where all is well; otherwise what is wrong with which piece.
inline std::string fault(const FracturedBody& body, double wholeVolume) {
  double sum = 0;
  for (std::size_t p = 0; p < body.pieces.size(); ++p) {
    const auto places = trianglesOf(body.pieces[p]);
    const auto triangles = numbered(places);
    const std::string name = "piece " + std::to_string(p) + ": ";
    if (triangles.empty()) return name + "no triangles";
    if (const std::string edge = edgeFault(triangles); !edge.empty()) return name + edge;
    if (const std::string fan = fanFault(triangles); !fan.empty()) return name + fan;
    const double volume = volumeOf(places);
    if (!(volume > 0)) return name + "volume " + std::to_string(volume);
    sum += volume;
  }
  if (!(std::abs(sum - wholeVolume) <= 1e-6 * std::abs(wholeVolume)))
    return "volumes add up to " + std::to_string(sum) + " of " + std::to_string(wholeVolume);
  return sharingFault(body);
}

}  // namespace brisance::solid_checker
