#include "fluid/body_push.h"

#include <algorithm>
#include <map>

namespace brisance {

namespace {
struct Reach {
  Vec3d area, moment;
};

/// Coefficients by body and cell.
using Touched = std::map<std::pair<int, std::int64_t>, Reach>;

Touched touchedCells(const SolidStamp& solid, const CellLayout& layout) {
  Touched touched;
  for (const BodyFace& f : solid.bodyFaces) {
    const MovingSolid& body = solid.bodies[f.body];
    if (body.inverseMass == 0) continue;
    const Vec3d arm = solid.openShare.component(f.axis).position(f.face.x, f.face.y, f.face.z) - body.pose.position;
    Vec3d area;
    area[f.axis] = f.share;
    for (const int side : {1, -1}) {  // upper face of the cell below, lower face of the one above
      Vec3i cell = f.face;
      if (side == 1) --cell[f.axis];
      if (!solid.inside.contains(cell.x, cell.y, cell.z) || solid.inside(cell.x, cell.y, cell.z)) continue;
      Reach& reach = touched[{f.body, layout.index(cell.x, cell.y, cell.z)}];
      reach.area += area * static_cast<double>(side);
      reach.moment += cross(arm, area) * static_cast<double>(side);
    }
  }
  return touched;
}

/// The sum of the coefficients of one body over a region, and of their magnitudes.
struct RegionSum {
  Vec3d sum;
  double all = 0;
};
using RegionSums = std::map<std::pair<int, std::int32_t>, RegionSum>;  // by body and region

RegionSums sumRegions(const SolidStamp& solid, const CellLayout& layout, const Touched& touched) {
  RegionSums sums;
  for (const auto& [at, reach] : touched) {
    const std::int64_t inside = at.second - layout.first, inPlane = inside % layout.plane;
    const int k = static_cast<int>(inside / layout.plane), j = static_cast<int>(inPlane / layout.row);
    RegionSum& region = sums[{at.first, solid.region(static_cast<int>(inPlane % layout.row), j, k)}];
    region.sum += reach.area;
    region.all += length(reach.area);
  }
  return sums;
}
}  // namespace

BodyPush::BodyPush(const SolidStamp& solid, const CellLayout& layout, double density)
    : cellSize_(solid.openShare.u.cellSize), yielding_(solid.sealed.size(), 0), touched_(yielding_) {
  const Touched touched = touchedCells(solid, layout);
  const double scale = density * cellSize_ * cellSize_;
  for (const auto& [at, reach] : touched) {
    if (bodies_.empty() || bodies_.back().body != at.first) {
      const MovingSolid& body = solid.bodies[at.first];
      bodies_.push_back(
          {at.first, contacts_.size(), contacts_.size(), scale * body.inverseMass, body.inverseInertia * scale});
    }
    contacts_.push_back({at.second, 0, reach.area, reach.moment});
    bodies_.back().end = contacts_.size();
  }
  constexpr double rounding = 1e-4;
  for (const auto& [at, region] : sumRegions(solid, layout, touched)) {
    touched_[at.second] = 1;
    if (length(region.sum) > rounding * region.all) yielding_[at.second] = 1;
  }
}

void BodyPush::apply(const CellField& x, FluidState& gas) const {
  if (empty()) return;
  const std::vector<MotionChange> changes = response([&](const BodyContact& c) { return x.values[c.cell]; });
  std::vector<MotionChange> byBody(gas.solid.bodies.size());
  for (std::size_t n = 0; n < bodies_.size(); ++n) {
    MovingSolid& body = gas.solid.bodies[bodies_[n].body];
    body.velocity += changes[n].velocity;
    body.angularVelocity += changes[n].angularVelocity;
    byBody[bodies_[n].body] = changes[n];
  }
  for (const BodyFace& f : gas.solid.bodyFaces) {
    const MovingSolid& body = gas.solid.bodies[f.body];
    Grid3<float>& speed = gas.velocity.component(f.axis);
    const Vec3d arm = speed.position(f.face.x, f.face.y, f.face.z) - body.pose.position;
    const Vec3d change = byBody[f.body].velocity + cross(byBody[f.body].angularVelocity, arm);
    speed.values[f.index] = static_cast<float>(speed.values[f.index] + f.share * change[f.axis]);
  }
}

}  // namespace brisance
