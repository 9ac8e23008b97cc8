#include "fracture/surface_cutting.h"

#include <tbb/parallel_sort.h>

#include "base/cancellation.h"
#include "base/check.h"
#include "base/parallel.h"

namespace brisance {
namespace {

constexpr std::int64_t blockSize = 4096;

struct NamedSegment {
  std::uint32_t lowCell, highCell, from, to;  ///< places in the block's names
};

/// What one block of triangles yields, its vertices still by name.
struct CutBlock {
  std::vector<CutPolygon> polygons;  ///< `first` counts in the block's names
  std::vector<CutPoint> names;       ///< of polygon corners
  std::vector<NamedSegment> segments;
};

class BlockCutter {
 public:
  BlockCutter(const SolidSurface& surface, const CellDiagram& diagram, const CutSurface& cut, CutBlock& block)
      : surface_(surface), cut_(cut), block_(block), clipper_(diagram) {}

  void cut(std::uint32_t triangle) {
    const auto& [a, b, c] = surface_.triangles[triangle];
    for (const ClippedTriangle& polygon :
         clipper_.clip({cut_.lattice[a], cut_.lattice[b], cut_.lattice[c]}, cut_.cellOfVertex[a]))
      add(triangle, polygon);
  }

 private:
  void add(std::uint32_t triangle, const ClippedTriangle& polygon) {
    const auto first = static_cast<std::uint32_t>(block_.names.size());
    const auto count = static_cast<std::uint32_t>(polygon.sides.size());
    block_.polygons.push_back({triangle, polygon.cell, first, count});
    for (std::uint32_t k = 0; k < count; ++k) {
      const ClipSide &before = polygon.sides[(k + count - 1) % count], &after = polygon.sides[k];
      block_.names.push_back(nameOf(triangle, polygon.cell, before, after));
      // Each stretch is met from both cells; the face lies on the other side of it than the polygon.
      if (after.cell != noCell && polygon.cell < after.cell)
        block_.segments.push_back({polygon.cell, after.cell, first + (k + 1) % count, first + k});
    }
  }

  CutPoint nameOf(std::uint32_t triangle, std::uint32_t cell, const ClipSide& before, const ClipSide& after) const {
    const Triangle& corners = surface_.triangles[triangle];
    if (before.cell == noCell && after.cell == noCell) return {CutPoint::corner, {corners[after.edge], 0, 0, 0}};
    if (before.cell != noCell && after.cell != noCell) {
      std::array<std::uint32_t, 3> cells{cell, before.cell, after.cell};
      std::sort(cells.begin(), cells.end());
      return {CutPoint::inTriangle, {triangle, cells[0], cells[1], cells[2]}};
    }
    const ClipSide &edge = before.cell == noCell ? before : after, &plane = before.cell == noCell ? after : before;
    const auto [u, v] = std::minmax(corners[edge.edge], corners[(edge.edge + 1) % 3]);
    const auto [i, j] = std::minmax(cell, plane.cell);
    return {CutPoint::onEdge, {u, v, i, j}};
  }

  const SolidSurface& surface_;
  const CutSurface& cut_;
  CutBlock& block_;
  TriangleClipper clipper_;
};

void placeVertices(CutSurface& cut, const SolidSurface& surface, const CellDiagram& diagram,
                   const CellLattice& lattice) {
  const std::size_t count = surface.places.size();
  cut.lattice.resize(count);
  cut.cellOfVertex.resize(count);
  parallelFor(0, static_cast<std::int64_t>(count), blockSize, [&](std::int64_t begin, std::int64_t end) {
    std::uint32_t cell = noCell;
    for (std::int64_t v = begin; v < end; ++v) {
      cut.lattice[v] = lattice.vertex(surface.places[v]);
      cell = cut.cellOfVertex[v] = diagram.cellOf(cut.lattice[v], cell);
    }
  });
}

/// Cells are convex: a triangle lies in one where its corners do.
void placeTriangle(CutSurface& cut, const Triangle& corners, std::uint32_t triangle) {
  const std::uint32_t cell = cut.cellOfVertex[corners[0]];
  const bool whole = cut.cellOfVertex[corners[1]] == cell && cut.cellOfVertex[corners[2]] == cell;
  cut.cellOfTriangle[triangle] = whole ? cell : noCell;
}

std::vector<CutBlock> cutBlocks(CutSurface& cut, const SolidSurface& surface, const CellDiagram& diagram) {
  const auto count = static_cast<std::int64_t>(surface.triangles.size());
  cut.cellOfTriangle.resize(surface.triangles.size());
  std::vector<CutBlock> blocks((count + blockSize - 1) / blockSize);
  parallelFor(0, static_cast<std::int64_t>(blocks.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b) {
      BlockCutter cutter(surface, diagram, cut, blocks[b]);
      for (std::int64_t t = b * blockSize; t < std::min(count, (b + 1) * blockSize); ++t) {
        const auto triangle = static_cast<std::uint32_t>(t);
        placeTriangle(cut, surface.triangles[triangle], triangle);
        if (cut.cellOfTriangle[triangle] == noCell) cutter.cut(triangle);
      }
    }
  });
  return blocks;
}

std::vector<CutPoint> distinctPoints(const std::vector<CutBlock>& blocks) {
  std::vector<CutPoint> points;
  for (const CutBlock& block : blocks)
    std::copy_if(block.names.begin(), block.names.end(), std::back_inserter(points),
                 [](const CutPoint& name) { return name.kind != CutPoint::corner; });
  tbb::parallel_sort(points.begin(), points.end());
  throwIfCancelled();
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// Names become numbers.
void number(CutSurface& cut, const std::vector<CutBlock>& blocks) {
  std::vector<std::uint32_t> firstName(blocks.size() + 1, 0);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    firstName[b + 1] = firstName[b] + static_cast<std::uint32_t>(blocks[b].names.size());
  cut.corners.resize(firstName.back());
  const auto surfaceVertices = static_cast<std::uint32_t>(cut.cellOfVertex.size());
  parallelFor(0, static_cast<std::int64_t>(blocks.size()), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t b = begin; b < end; ++b)
      for (std::size_t n = 0; n < blocks[b].names.size(); ++n) {
        const CutPoint& name = blocks[b].names[n];
        const auto place = std::lower_bound(cut.points.begin(), cut.points.end(), name) - cut.points.begin();
        cut.corners[firstName[b] + n] =
            name.kind == CutPoint::corner ? name.of[0] : surfaceVertices + static_cast<std::uint32_t>(place);
      }
  });
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (CutPolygon polygon : blocks[b].polygons) {
      polygon.first += firstName[b];
      cut.polygons.push_back(polygon);
    }
    for (const NamedSegment& s : blocks[b].segments)
      cut.segments.push_back(
          {s.lowCell, s.highCell, cut.corners[firstName[b] + s.from], cut.corners[firstName[b] + s.to]});
  }
}

}  // namespace

CutSurface cutSurface(const SolidSurface& surface, const CellDiagram& diagram, const CellLattice& lattice) {
  CutSurface cut;
  placeVertices(cut, surface, diagram, lattice);
  const std::vector<CutBlock> blocks = cutBlocks(cut, surface, diagram);
  cut.points = distinctPoints(blocks);
  number(cut, blocks);
  tbb::parallel_sort(cut.segments.begin(), cut.segments.end());
  throwIfCancelled();
  return cut;
}

Vec3d sharesOf(const CutPoint& point, const CutSurface& cut, const SolidSurface& surface, const CellDiagram& diagram) {
  const auto& [a, b, c, d] = point.of;
  const auto nearer = [&](std::uint32_t cell, std::uint32_t other, std::uint32_t vertex) {
    return diagram.power(other, cut.lattice[vertex]) - diagram.power(cell, cut.lattice[vertex]);
  };
  if (point.kind == CutPoint::onEdge) {
    const double first = std::abs(static_cast<double>(nearer(c, d, a)));
    const double second = std::abs(static_cast<double>(nearer(c, d, b)));
    return {second / (first + second), first / (first + second), 0};
  }
  CHECK(point.kind == CutPoint::inTriangle, "a corner is no cut point");
  Vec3l rowA, rowB;
  for (int corner = 0; corner < 3; ++corner) {
    rowA[corner] = nearer(b, c, surface.triangles[a][corner]);
    rowB[corner] = nearer(b, d, surface.triangles[a][corner]);
  }
  const Vec3d share(meeting(rowA, rowB));
  return share / (share.x + share.y + share.z);
}

}  // namespace brisance
