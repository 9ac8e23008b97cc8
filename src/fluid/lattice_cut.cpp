#include "fluid/lattice_cut.h"

#include <algorithm>
#include <cmath>

#include "fluid/face_coverage.h"

namespace brisance {

namespace {
/// The two axes across one.
struct Across {
  int p, q;
  explicit Across(int axis) : p(axis == 0 ? 1 : 0), q(axis == 2 ? 1 : 2) {}
};

Vec3i placeOf(int axis, int a, int p, int q) {
  const Across across(axis);
  Vec3i place;
  place[axis] = a;
  place[across.p] = p;
  place[across.q] = q;
  return place;
}

bool before(const Vec3i& a, const Vec3i& b) { return a.z != b.z ? a.z < b.z : a.y != b.y ? a.y < b.y : a.x < b.x; }

std::vector<Corners> trianglesInCells(const LatticeBox& box, const MovingSolid& solid) {
  std::vector<Vec3d> places;
  for (const Vec3d& vertex : solid.mesh->vertices) places.push_back(box.inCells(solid.pose * vertex));
  std::vector<Corners> triangles;
  for (const Triangle& t : solid.mesh->triangles) triangles.push_back({places[t[0]], places[t[1]], places[t[2]]});
  return triangles;
}

/// Whole squares that a body may cover, in the box.
SquareWindow windowOf(const LatticeBox& box, const Box3& bounds, int axis) {
  const Across across(axis);
  const auto lower = [&](int b) {
    return static_cast<int>(std::clamp(std::floor(bounds.lower[b]), 0.0, box.cells[b] + 0.0));
  };
  const auto upper = [&](int b) {
    return static_cast<int>(std::clamp(std::ceil(bounds.upper[b]), 0.0, box.cells[b] + 0.0));
  };
  return {lower(across.p), upper(across.p), lower(across.q), upper(across.q)};
}

/// The place on an edge at which it passes the plane, the same whichever way the edge is followed.
Vec2d onPlane(const Vec3d& a, const Vec3d& b, int axis, double plane) {
  const Across across(axis);
  const bool rising = a[axis] < b[axis];
  const Vec3d &low = rising ? a : b, &high = rising ? b : a;
  const double t = (plane - low[axis]) / (high[axis] - low[axis]);
  return {low[across.p] + t * (high[across.p] - low[across.p]), low[across.q] + t * (high[across.q] - low[across.q])};
}

/// The edge that a plane of faces cuts from a triangle, directed alike for all triangles of a mesh. A corner in the
/// plane counts as above it.
void addCut(const Corners& t, int axis, double plane, CoverageSum& sum) {
  Vec2d up, down;
  bool cut = false;
  for (int n = 0; n < 3; ++n) {
    const Vec3d &a = t[n], &b = t[(n + 1) % 3];
    const bool aAbove = a[axis] >= plane, bAbove = b[axis] >= plane;
    if (aAbove == bAbove) continue;
    (bAbove ? up : down) = onPlane(a, b, axis, plane);
    cut = true;
  }
  if (cut) sum.addEdge(up, down);
}

/// Triangles by the planes that they may cut.
std::vector<std::vector<int>> trianglesByPlane(const std::vector<Corners>& triangles, int axis, int planes) {
  std::vector<std::vector<int>> byPlane(planes);
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    const Corners& t = triangles[n];
    const double lower = std::min({t[0][axis], t[1][axis], t[2][axis]});
    const double upper = std::max({t[0][axis], t[1][axis], t[2][axis]});
    const int first = static_cast<int>(std::clamp(std::ceil(lower), 0.0, planes + 0.0));
    const int end = static_cast<int>(std::clamp(std::floor(upper) + 1, 0.0, planes + 0.0));
    for (int plane = first; plane < end; ++plane) byPlane[plane].push_back(static_cast<int>(n));
  }
  return byPlane;
}

void coverFaces(const LatticeBox& box, const Box3& bounds, int axis, BodyCut& cut) {
  const SquareWindow window = windowOf(box, bounds, axis);
  if (window.empty()) return;
  const auto byPlane = trianglesByPlane(cut.triangles, axis, box.cells[axis] + 1);
  for (int plane = 0; plane <= box.cells[axis]; ++plane) {
    if (byPlane[plane].empty()) continue;
    CoverageSum sum(window);
    for (const int n : byPlane[plane]) addCut(cut.triangles[n], axis, plane, sum);
    sum.finish();
    for (int q = window.q0; q < window.q1; ++q)
      for (int p = window.p0; p < window.p1; ++p)
        if (sum.share(p, q) > 0) cut.faces[axis].push_back({placeOf(axis, plane, p, q), sum.share(p, q), false});
  }
}

/// Where the surface meets the line of cell centres (p, q).
struct Crossing {
  int p, q;
  double place;
};

/// Lines lie at p + 1/2, q + 1/2. The shift decides for lines that run exactly through a corner or along an edge of a
/// mesh laid on the lattice.
void crossLines(const Corners& t, int axis, const LatticeBox& box, std::vector<Crossing>& crossings) {
  constexpr double shift = 1e-9;
  const Across across(axis);
  const auto low = [&](int b) {
    return static_cast<int>(std::max(0.0, std::floor(std::min({t[0][b], t[1][b], t[2][b]}) - 0.5)));
  };
  const auto high = [&](int b) {
    return static_cast<int>(std::min(box.cells[b] - 1.0, std::ceil(std::max({t[0][b], t[1][b], t[2][b]}) - 0.5)));
  };
  const Vec3d ab = t[1] - t[0], ac = t[2] - t[0];
  const double area = ab[across.p] * ac[across.q] - ac[across.p] * ab[across.q];
  if (area == 0) return;
  for (int q = low(across.q); q <= high(across.q); ++q)
    for (int p = low(across.p); p <= high(across.p); ++p) {
      const double x = p + 0.5 + shift - t[0][across.p], y = q + 0.5 + 1.7 * shift - t[0][across.q];
      const double w1 = (x * ac[across.q] - ac[across.p] * y) / area;
      const double w2 = (ab[across.p] * y - x * ab[across.q]) / area;
      if (w1 < 0 || w2 < 0 || w1 + w2 > 1) continue;
      crossings.push_back({p, q, t[0][axis] + w1 * ab[axis] + w2 * ac[axis]});
    }
}

std::vector<Crossing> crossingsAlong(int axis, const LatticeBox& box, const std::vector<Corners>& triangles) {
  std::vector<Crossing> crossings;
  for (const Corners& triangle : triangles) crossLines(triangle, axis, box, crossings);
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.q != b.q ? a.q < b.q : a.p != b.p ? a.p < b.p : a.place < b.place;
  });
  return crossings;
}

void crossFaces(const LatticeBox& box, int axis, const std::vector<Crossing>& crossings, BodyCut& cut) {
  for (const Crossing& c : crossings) {
    if (c.place <= 0 || c.place >= box.cells[axis]) continue;
    const int face = static_cast<int>(std::ceil(c.place - 0.5));  // between the centres of cells face - 1 and face
    cut.faces[axis].push_back({placeOf(axis, face, c.p, c.q), 0, true});
  }
}

/// Centres between an odd crossing of their line and the next lie inside, those on the surface too.
void markInside(const LatticeBox& box, int axis, const std::vector<Crossing>& crossings, BodyCut& cut) {
  const auto sameLine = [&](std::size_t m, std::size_t n) {
    return crossings[m].p == crossings[n].p && crossings[m].q == crossings[n].q;
  };
  for (std::size_t n = 0; n + 1 < crossings.size();) {
    if (!sameLine(n, n + 1)) {
      ++n;
      continue;
    }
    const int from = static_cast<int>(std::max(0.0, std::ceil(crossings[n].place - 0.5)));
    const int to = static_cast<int>(std::min(box.cells[axis] - 1.0, std::floor(crossings[n + 1].place - 0.5)));
    for (int a = from; a <= to; ++a) cut.insideCentres.push_back(placeOf(axis, a, crossings[n].p, crossings[n].q));
    n += 2;
  }
}

/// Sorted, and what is said of one face in one place.
void mergeFaces(std::vector<FaceCut>& faces) {
  std::sort(faces.begin(), faces.end(), [](const FaceCut& a, const FaceCut& b) { return before(a.face, b.face); });
  std::size_t kept = 0;
  for (const FaceCut& face : faces) {
    if (kept > 0 && faces[kept - 1].face == face.face) {
      FaceCut& same = faces[kept - 1];
      same.covered = std::max(same.covered, face.covered);
      same.crossed = same.crossed || face.crossed;
    } else {
      faces[kept++] = face;
    }
  }
  faces.resize(kept);
}
}  // namespace

BodyCut cutLattice(const LatticeBox& box, const MovingSolid& solid, bool watertight) {
  BodyCut cut;
  cut.triangles = trianglesInCells(box, solid);
  Box3 bounds;
  for (const Corners& t : cut.triangles)
    for (const Vec3d& corner : t) bounds.include(corner);
  for (int axis = 0; axis < 3; ++axis)
    if (bounds.upper[axis] < 0 || bounds.lower[axis] > box.cells[axis]) return {};
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<Crossing> crossings = crossingsAlong(axis, box, cut.triangles);
    if (watertight) {
      coverFaces(box, bounds, axis, cut);
      markInside(box, axis, crossings, cut);
    }
    crossFaces(box, axis, crossings, cut);
    mergeFaces(cut.faces[axis]);
  }
  auto& inside = cut.insideCentres;
  std::sort(inside.begin(), inside.end(), before);
  inside.erase(std::unique(inside.begin(), inside.end()), inside.end());
  return cut;
}

}  // namespace brisance
