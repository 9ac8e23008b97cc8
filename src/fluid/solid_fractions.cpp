#include "fluid/solid_fractions.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace brisance {

namespace {
constexpr std::int32_t solidCell = -1, unvisited = -2;

/// Where a triangle crosses the lines of cell centres along one axis: per line (p, q) the places along the axis, in
/// cells.
using Crossings = std::map<std::int64_t, std::vector<double>>;

struct Corner {
  double a, p, q;  // along the axis and across it, in cells from the first cell centre
};

/// Lines lie at whole (p, q). Those exactly on an edge belong to one side by the sign of the shift, as in a rasteriser.
void rasterise(const Corner (&t)[3], const Vec3i& linesAcross, Crossings& crossings) {
  constexpr double shift = 1e-9;  // no line runs exactly through a corner or along an edge of a mesh laid on the grid
  const double lowP = std::min({t[0].p, t[1].p, t[2].p}), highP = std::max({t[0].p, t[1].p, t[2].p});
  const double lowQ = std::min({t[0].q, t[1].q, t[2].q}), highQ = std::max({t[0].q, t[1].q, t[2].q});
  const double area = (t[1].p - t[0].p) * (t[2].q - t[0].q) - (t[2].p - t[0].p) * (t[1].q - t[0].q);
  if (area == 0) return;
  const int p0 = static_cast<int>(std::max(0.0, std::floor(lowP))),
            q0 = static_cast<int>(std::max(0.0, std::floor(lowQ)));
  const int p1 = static_cast<int>(std::min(linesAcross.x - 1.0, std::ceil(highP)));
  const int q1 = static_cast<int>(std::min(linesAcross.y - 1.0, std::ceil(highQ)));
  for (int q = q0; q <= q1; ++q)
    for (int p = p0; p <= p1; ++p) {
      const double x = p + shift, y = q + 1.7 * shift;
      const double w1 = ((x - t[0].p) * (t[2].q - t[0].q) - (t[2].p - t[0].p) * (y - t[0].q)) / area;
      const double w2 = ((t[1].p - t[0].p) * (y - t[0].q) - (x - t[0].p) * (t[1].q - t[0].q)) / area;
      if (w1 < 0 || w2 < 0 || w1 + w2 > 1) continue;
      crossings[p + static_cast<std::int64_t>(q) * linesAcross.x].push_back(t[0].a + w1 * (t[1].a - t[0].a) +
                                                                            w2 * (t[2].a - t[0].a));
    }
}

Crossings crossingsAlong(int axis, const FluidSettings& s, const MovingSolid& solid) {
  const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  const Vec3d first = s.corner + Vec3d(.5, .5, .5) * s.cellSize;
  const Vec3i lines{s.cells[b], s.cells[c], 0};
  Crossings crossings;
  for (const Triangle& triangle : solid.mesh->triangles) {
    Corner corners[3];
    for (int n = 0; n < 3; ++n) {
      const Vec3d p = (solid.pose * solid.mesh->vertices[triangle[n]] - first) / s.cellSize;
      corners[n] = {p[axis], p[b], p[c]};
    }
    rasterise(corners, lines, crossings);
  }
  for (auto& [line, places] : crossings) std::sort(places.begin(), places.end());
  return crossings;
}

void closeFaces(int axis, const Crossings& crossings, const Vec3i& cells, Grid3<float>& open) {
  const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  for (const auto& [line, places] : crossings) {
    const std::int64_t p = line % cells[b], q = line / cells[b];
    for (const double place : places) {
      const double face = std::ceil(place);                       // between the centres face - 1 and face
      if (place <= -0.5 || place >= cells[axis] - 0.5) continue;  // outside the box
      open.values[static_cast<std::int64_t>(face) * open.stride(axis) + p * open.stride(b) + q * open.stride(c)] = 0;
    }
  }
}

/// Cell centres between an odd crossing and the next lie inside.
void markInside(const Crossings& alongX, Grid3<std::uint8_t>& inside) {
  for (const auto& [line, places] : alongX)
    for (std::size_t n = 0; n + 1 < places.size(); n += 2) {
      const int from = std::max(0, static_cast<int>(std::ceil(places[n])));
      const int to = std::min(inside.size.x - 1, static_cast<int>(std::floor(places[n + 1])));
      for (int i = from; i <= to; ++i) inside.values[i + line * inside.size.x] = 1;
    }
}

void closeAroundSolidCells(SolidStamp& stamp) {
  const Grid3<std::uint8_t>& inside = stamp.inside;
  for (int k = 0; k < inside.size.z; ++k)
    for (int j = 0; j < inside.size.y; ++j)
      for (int i = 0; i < inside.size.x; ++i)
        if (inside(i, j, k))
          for (int axis = 0; axis < 3; ++axis) {
            Grid3<float>& open = stamp.openShare.component(axis);
            const std::int64_t face = open.index(i, j, k);
            open.values[face] = open.values[face + open.stride(axis)] = 0;
          }
}

bool isWall(FaceKind kind) { return kind == FaceKind::noSlip || kind == FaceKind::freeSlip; }

/// Calls visit(lower, upper) with the shares of the two faces at the ends of each row of cells along an axis.
template <class Visit>
void forEnds(Grid3<float>& open, int axis, const Visit& visit) {
  const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  const std::int64_t far = (open.size[axis] - 1) * open.stride(axis);
  for (int q = 0; q < open.size[c]; ++q)
    for (int p = 0; p < open.size[b]; ++p) {
      const std::int64_t at = p * open.stride(b) + q * open.stride(c);
      visit(open.values[at], open.values[at + far]);
    }
}

/// Two faces that are one because the box is periodic let through what both do.
void joinPeriodicFaces(const Faces& faces, MacVelocity& openShare) {
  for (int axis = 0; axis < 3; ++axis)
    if (faces[2 * axis] == FaceKind::periodic)
      forEnds(openShare.component(axis), axis,
              [](float& lower, float& upper) { lower = upper = std::min(lower, upper); });
}

/// Whether every face is wholly open but for the box's walls.
bool isEmpty(const Faces& faces, const MacVelocity& openShare) {
  for (int axis = 0; axis < 3; ++axis) {
    const Grid3<float>& open = openShare.component(axis);
    const Vec3i size = open.size;
    Vec3i first, last = size;
    if (isWall(faces[2 * axis])) ++first[axis];
    if (isWall(faces[2 * axis + 1])) --last[axis];
    for (int k = first.z; k < last.z; ++k)
      for (int j = first.y; j < last.y; ++j)
        for (int i = first.x; i < last.x; ++i)
          if (open(i, j, k) != 1) return false;
  }
  return true;
}

void closeBoxFaces(const Faces& faces, MacVelocity& openShare) {
  for (int face = 0; face < 6; ++face) {
    if (!isWall(faces[face])) continue;
    const int axis = face / 2;
    Grid3<float>& open = openShare.component(axis);
    for (int k = 0; k < open.size.z; ++k)
      for (int j = 0; j < open.size.y; ++j)
        for (int i = 0; i < open.size.x; ++i) {
          const int place[3] = {i, j, k};
          if (place[axis] == (face % 2 ? open.size[axis] - 1 : 0)) open(i, j, k) = 0;
        }
  }
}

/// Fills everything that gas from `seed` reaches with `number`; true if that includes an open face of the box.
bool flood(SolidStamp& stamp, const Faces& faces, std::int64_t seed, int number) {
  Grid3<std::int32_t>& pocket = stamp.pocket;
  bool reachesOutside = false;
  std::vector<std::int64_t> stack{seed};
  pocket.values[seed] = number;
  while (!stack.empty()) {
    const std::int64_t cell = stack.back();
    stack.pop_back();
    const int place[3] = {static_cast<int>(cell % pocket.size.x),
                          static_cast<int>(cell / pocket.size.x % pocket.size.y),
                          static_cast<int>(cell / pocket.stride(2))};
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        const Grid3<float>& open = stamp.openShare.component(axis);
        if (open.values[open.index(place[0], place[1], place[2]) + side * open.stride(axis)] == 0) continue;
        const bool atEnd = place[axis] == (side ? pocket.size[axis] - 1 : 0);
        if (atEnd && faces[2 * axis + side] != FaceKind::periodic) {
          reachesOutside = true;
          continue;
        }
        const std::int64_t step = (side ? 1 : -1) * pocket.stride(axis);
        const std::int64_t next = atEnd ? cell - step * (pocket.size[axis] - 1) : cell + step;
        if (pocket.values[next] != unvisited) continue;
        pocket.values[next] = number;
        stack.push_back(next);
      }
  }
  return reachesOutside;
}

void findPockets(SolidStamp& stamp, const Faces& faces) {
  for (std::int64_t cell = 0; cell < stamp.inside.count(); ++cell)
    stamp.pocket.values[cell] = stamp.inside.values[cell] ? solidCell : unvisited;
  std::vector<int> finalNumber{0};  // by flood number: 0 where it reaches the outside
  for (std::int64_t cell = 0; cell < stamp.inside.count(); ++cell)
    if (stamp.pocket.values[cell] == unvisited) {
      const bool outside = flood(stamp, faces, cell, static_cast<int>(finalNumber.size()));
      finalNumber.push_back(outside ? 0 : ++stamp.pocketCount);
    }
  for (std::int32_t& number : stamp.pocket.values)
    if (number > 0) number = finalNumber[number];
}
}  // namespace

SolidStamp stampSolids(const FluidSettings& settings, std::span<const MovingSolid> solids) {
  SolidStamp stamp;
  stamp.inside = cellGrid<std::uint8_t>(settings, 0);
  stamp.pocket = cellGrid<std::int32_t>(settings, 0);
  stamp.openShare = MacVelocity(settings.cells, settings.corner, settings.cellSize);
  for (int axis = 0; axis < 3; ++axis) {
    auto& open = stamp.openShare.component(axis).values;
    std::fill(open.begin(), open.end(), 1.0f);
  }
  for (const MovingSolid& solid : solids)
    for (int axis = 0; axis < 3; ++axis) {
      const Crossings crossings = crossingsAlong(axis, settings, solid);
      closeFaces(axis, crossings, settings.cells, stamp.openShare.component(axis));
      if (axis == 0) markInside(crossings, stamp.inside);
    }
  closeAroundSolidCells(stamp);
  closeBoxFaces(settings.faces, stamp.openShare);
  joinPeriodicFaces(settings.faces, stamp.openShare);
  findPockets(stamp, settings.faces);
  stamp.empty = isEmpty(settings.faces, stamp.openShare);
  return stamp;
}

}  // namespace brisance
