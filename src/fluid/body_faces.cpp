#include "fluid/body_faces.h"

#include <algorithm>
#include <tuple>

#include "base/parallel.h"

namespace brisance {

namespace {
/// How much a body has to do with a face.
struct Claim {
  int axis;
  std::int64_t index;
  int body;
  Vec3i face;
  float weight;
  auto order() const { return std::tuple(axis, index, body); }
};

std::vector<Claim> claimsOf(const LatticeBox& box, const std::vector<BodyCut>& moving) {
  std::vector<Claim> claims;
  for (std::size_t body = 0; body < moving.size(); ++body)
    for (int axis = 0; axis < 3; ++axis)
      for (const FaceCut& cut : moving[body].faces[axis])
        claims.push_back({axis, box.faceIndex(axis, cut.face), static_cast<int>(body), cut.face,
                          static_cast<float>(cut.covered) + (cut.crossed ? 1 : 0)});
  std::sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) { return a.order() < b.order(); });
  return claims;
}

float weightOf(const SolidLattice& lattice, int axis, std::int64_t index) {
  return std::min(1.0f, lattice.covered.component(axis).values[index]) + lattice.crossed[axis].values[index];
}

bool isBoxWall(const FluidSettings& settings, int axis, const Vec3i& face) {
  const auto isWall = [](FaceKind kind) { return kind == FaceKind::noSlip || kind == FaceKind::freeSlip; };
  return (face[axis] == 0 && isWall(settings.faces[lowerFaceOf(axis)])) ||
         (face[axis] == settings.cells[axis] && isWall(settings.faces[upperFaceOf(axis)]));
}

/// Shares of the faces that bodies cover or cross.
void addClaimed(const BodyFaceSearch& search, const std::vector<Claim>& claims, const MacVelocity& openShare,
                std::vector<BodyFace>& out) {
  for (auto claim = claims.begin(); claim != claims.end();) {
    const auto next = std::find_if(claim, claims.end(), [&](const Claim& other) {
      return other.axis != claim->axis || other.index != claim->index;
    });
    const float closed = 1 - openShare.component(claim->axis).values[claim->index];
    float sum = weightOf(search.fixed, claim->axis, claim->index);
    for (auto one = claim; one != next; ++one) sum += one->weight;
    if (closed > 0 && sum > 0 && !isBoxWall(search.settings, claim->axis, claim->face))
      for (auto one = claim; one != next; ++one)
        if (one->weight > 0) out.push_back({one->axis, one->body, one->face, one->index, closed * (one->weight / sum)});
    claim = next;
  }
}

/// The body with the most to do with the faces of the two cells at a face; -1: none moving has.
int ownerOf(const BodyFaceSearch& search, const std::vector<Claim>& claims, int axis, const Vec3i& face) {
  int owner = -1;
  float most = 0;
  for (int cellSide = -1; cellSide <= 0; ++cellSide)
    for (int a = 0; a < 3; ++a)
      for (int side = 0; side < 2; ++side) {
        Vec3i place = face;
        place[axis] += cellSide;
        if (!search.box.contains(place)) continue;
        place[a] += side;
        const std::int64_t index = search.box.faceIndex(a, place);
        const float fixedWeight = weightOf(search.fixed, a, index);
        if (fixedWeight > most) {
          most = fixedWeight;
          owner = -1;
        }
        const Claim wanted{a, index, -1, {}, 0};
        auto claim = std::upper_bound(claims.begin(), claims.end(), wanted,
                                      [](const Claim& x, const Claim& y) { return x.order() < y.order(); });
        for (; claim != claims.end() && claim->axis == a && claim->index == index; ++claim)
          if (claim->weight > most) {
            most = claim->weight;
            owner = claim->body;
          }
      }
  return owner;
}

/// Faces of a row that are closed although no body covers or crosses them.
void addUnclaimed(const BodyFaceSearch& search, const std::vector<Claim>& claims, const MacVelocity& openShare,
                  Vec3i row, std::vector<BodyFace>& out) {
  for (int axis = 0; axis < 3; ++axis) {
    const Grid3<float>& open = openShare.component(axis);
    for (row.x = 0; row.x < open.size.x; ++row.x) {
      const std::int64_t index = open.index(row.x, row.y, row.z);
      if (open.values[index] > 0 || weightOf(search.all, axis, index) > 0) continue;
      if (isBoxWall(search.settings, axis, row)) continue;
      const int owner = ownerOf(search, claims, axis, row);
      if (owner >= 0) out.push_back({axis, owner, row, index, 1});
    }
  }
}
}  // namespace

std::vector<BodyFace> sharesOfBodies(const BodyFaceSearch& search, const std::vector<BodyCut>& moving,
                                     const RowSet& rows, const MacVelocity& openShare) {
  const std::vector<Claim> claims = claimsOf(search.box, moving);
  std::vector<BodyFace> out;
  addClaimed(search, claims, openShare, out);
  const Vec3i n = search.settings.cells;
  std::vector<std::vector<BodyFace>> byPlane(n.z);
  rows.forEachPlane([&](int k) {
    for (int j = 0; j < n.y; ++j)
      if (rows.contains(j, k)) addUnclaimed(search, claims, openShare, {0, j, k}, byPlane[k]);
  });
  for (const auto& plane : byPlane) out.insert(out.end(), plane.begin(), plane.end());
  std::sort(out.begin(), out.end(), [](const BodyFace& a, const BodyFace& b) {
    return std::tuple(a.axis, a.index, a.body) < std::tuple(b.axis, b.index, b.body);
  });
  return out;
}

}  // namespace brisance
