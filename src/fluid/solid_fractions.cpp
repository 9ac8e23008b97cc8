#include "fluid/solid_fractions.h"

#include <algorithm>

#include "base/parallel.h"
#include "fluid/body_faces.h"
#include "fluid/gas_regions.h"
#include "mesh/mesh_topology.h"

namespace brisance {

namespace {
void closeBoxFaces(const Faces& faces, MacVelocity& openShare) {
  for (int face = 0; face < 6; ++face) {
    if (faces[face] != FaceKind::noSlip && faces[face] != FaceKind::freeSlip) continue;
    const int axis = face / 2, b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
    Grid3<float>& open = openShare.component(axis);
    const std::int64_t layer = face % 2 ? (open.size[axis] - 1) * open.stride(axis) : 0;
    for (int q = 0; q < open.size[c]; ++q)
      for (int p = 0; p < open.size[b]; ++p) open.values[layer + p * open.stride(b) + q * open.stride(c)] = 0;
  }
}

/// A box without bodies.
SolidStamp emptyStamp(const FluidSettings& settings) {
  SolidStamp stamp;
  stamp.inside = cellGrid<std::uint8_t>(settings, 0);
  stamp.region = cellGrid<std::int32_t>(settings, 0);
  stamp.openShare = MacVelocity(settings.cells, settings.corner, settings.cellSize);
  stamp.cutRows.assign(static_cast<std::size_t>(settings.cells.y) * settings.cells.z, 0);
  for (int axis = 0; axis < 3; ++axis) {
    auto& open = stamp.openShare.component(axis).values;
    std::fill(open.begin(), open.end(), 1.0f);
  }
  closeBoxFaces(settings.faces, stamp.openShare);
  return stamp;
}

std::vector<Corners> allTriangles(const std::vector<BodyCut>& cuts) {
  std::vector<Corners> triangles;
  for (const BodyCut& cut : cuts) triangles.insert(triangles.end(), cut.triangles.begin(), cut.triangles.end());
  return triangles;
}

void copyShares(const SolidStamp& from, int j, int k, SolidStamp& to) {
  const Vec3i n = from.inside.size;
  const auto copy = [](const auto& source, int row, int plane, auto& target) {
    std::copy_n(source.values.begin() + source.index(0, row, plane), source.size.x,
                target.values.begin() + target.index(0, row, plane));
  };
  copy(from.inside, j, k, to.inside);
  copy(from.openShare.u, j, k, to.openShare.u);
  copy(from.openShare.v, j, k, to.openShare.v);
  copy(from.openShare.w, j, k, to.openShare.w);
  if (j + 1 == n.y) copy(from.openShare.v, n.y, k, to.openShare.v);
  if (k + 1 == n.z) copy(from.openShare.w, j, n.z, to.openShare.w);
  const std::size_t row = j + static_cast<std::size_t>(n.y) * k;
  to.cutRows[row] = from.cutRows[row];
}
}  // namespace

SolidStamper::SolidStamper(const FluidSettings& settings, std::span<const MovingSolid> fixed)
    : settings_(settings),
      box_(settings),
      fixedLattice_(settings),
      fixedStamp_(emptyStamp(settings)),
      changed_(settings.cells) {
  const std::vector<BodyCut> cuts = cut(fixed);
  fixedBins_ = TriangleBins(box_, allTriangles(cuts));
  RowSet touched(settings.cells);
  for (const BodyCut& body : cuts) fixedLattice_.add(body, box_, touched);
  evaluateRows(settings_, {box_, {&fixedBins_, nullptr}}, touched, fixedLattice_, fixedStamp_);
  fixedStamp_.empty = touched.empty();
  findRegions(settings.faces, fixedStamp_);
}

bool SolidStamper::isSolid(const MovingSolid& body) {
  const auto [entry, isNew] = watertight_.try_emplace(body.mesh, false);
  if (isNew) entry->second = isWatertight(welded(*body.mesh));
  return entry->second;
}

std::vector<BodyCut> SolidStamper::cut(std::span<const MovingSolid> bodies) {
  std::vector<std::uint8_t> solid;
  for (const MovingSolid& body : bodies) solid.push_back(isSolid(body));
  std::vector<BodyCut> cuts(bodies.size());
  parallelFor(0, static_cast<std::int64_t>(bodies.size()), 1, [&](std::int64_t first, std::int64_t last) {
    for (auto n = first; n < last; ++n) cuts[n] = cutLattice(box_, bodies[n], solid[n]);
  });
  return cuts;
}

/// Back to the fixed bodies alone.
void SolidStamper::restore(SolidStamp& stamp) {
  if (!lattice_) lattice_ = fixedLattice_;
  changed_.forEach([&](int j, int k) {
    lattice_->copyRow(fixedLattice_, j, k);
    copyShares(fixedStamp_, j, k, stamp);
  });
  stamp.bodyFaces.clear();
}

void SolidStamper::stampMoving(std::span<const MovingSolid> moving, SolidStamp& stamp) {
  restore(stamp);
  const std::vector<BodyCut> cuts = cut(moving);
  const TriangleBins bins(box_, allTriangles(cuts));
  RowSet touched(settings_.cells);
  for (const BodyCut& body : cuts) lattice_->add(body, box_, touched);
  evaluateRows(settings_, {box_, {&fixedBins_, &bins}}, touched, *lattice_, stamp);
  changed_ = touched.grown(settings_.faces, rowsOfInfluence);
  stamp.empty = fixedStamp_.empty && touched.empty();
  stamp.bodies.assign(moving.begin(), moving.end());
  stamp.bodyFaces = sharesOfBodies({settings_, box_, fixedLattice_, *lattice_}, cuts, changed_, stamp.openShare);
  findRegions(settings_.faces, stamp);
}

SolidStamp stampSolids(const FluidSettings& settings, std::span<const MovingSolid> solids) {
  return SolidStamper(settings, solids).fixed();
}

}  // namespace brisance
