#include "fluid/solid_lattice.h"

#include "base/parallel.h"

namespace brisance {

namespace {
constexpr float smallestShare = 1e-3f;  // a smaller opening is none: it would spoil the condition of the solvers
constexpr float leastOpen = 0.5f;       // sum over a cell's six faces, below which it counts as solid (3 % of a cell)

bool isWall(FaceKind kind) { return kind == FaceKind::noSlip || kind == FaceKind::freeSlip; }

/// Opens and closes faces and cells of the rows of one lattice.
class RowEvaluation {
 public:
  RowEvaluation(const FluidSettings& settings, const Surfaces& surfaces, SolidLattice& lattice, SolidStamp& stamp)
      : faces_(settings.faces), surfaces_(surfaces), n_(settings.cells), lattice_(lattice), stamp_(stamp) {}

  /// Where each cell of a row has its gas.
  void findGas(int j, int k) {
    std::vector<GasPoint>& points = lattice_.points[rowNumber(j, k)];
    points.clear();
    const GasPointSearch search{surfaces_, lattice_.centreInside};
    for (int i = 0; i < n_.x; ++i) {
      CellGas& gas = lattice_.gas(i, j, k);
      gas = CellGas::atCentre;
      if (!lattice_.centreInside(i, j, k)) continue;
      Vec3d place;
      const bool beside = mostCovered({i, j, k}) < 1 - smallestShare && findGasPoint(search, {i, j, k}, place);
      gas = beside ? CellGas::beside : CellGas::none;
      if (beside) points.push_back({i, place});
    }
  }

  /// The shares of the faces of a row, as the gas on both sides sees them.
  void openFaces(int j, int k) {
    forFacesOf(j, k, [&](int axis, const Vec3i& face) {
      stamp_.openShare.component(axis)(face.x, face.y, face.z) = shareOf(axis, face);
    });
  }

  void findSlivers(int j, int k) {
    for (int i = 0; i < n_.x; ++i) lattice_.sliver(i, j, k) = openSum({i, j, k}) < leastOpen;
  }

  void closeSlivers(int j, int k) {
    bool cut = false;
    forFacesOf(j, k, [&](int axis, const Vec3i& face) {
      float& share = stamp_.openShare.component(axis)(face.x, face.y, face.z);
      Vec3i lower = face;
      --lower[axis];
      if (isSliver(lower) || isSliver(face)) share = 0;
      cut = cut || (share < 1 && !isBoxWall(axis, face));
    });
    stamp_.cutRows[rowNumber(j, k)] = cut;
  }

  void findSolidCells(int j, int k) {
    for (int i = 0; i < n_.x; ++i) stamp_.inside(i, j, k) = openSum({i, j, k}) == 0;
  }

 private:
  std::size_t rowNumber(int j, int k) const { return j + static_cast<std::size_t>(n_.y) * k; }
  bool inBox(const Vec3i& cell) const { return surfaces_.box.contains(cell); }
  bool isSliver(const Vec3i& cell) const { return inBox(cell) && lattice_.sliver(cell.x, cell.y, cell.z); }

  /// The faces below the row's cells, and those that end the box.
  template <class Visit>
  void forFacesOf(int j, int k, const Visit& visit) const {
    for (int i = 0; i <= n_.x; ++i) visit(0, Vec3i{i, j, k});
    for (int i = 0; i < n_.x; ++i) visit(1, Vec3i{i, j, k});
    for (int i = 0; i < n_.x; ++i) visit(2, Vec3i{i, j, k});
    if (j + 1 == n_.y)
      for (int i = 0; i < n_.x; ++i) visit(1, Vec3i{i, n_.y, k});
    if (k + 1 == n_.z)
      for (int i = 0; i < n_.x; ++i) visit(2, Vec3i{i, j, n_.z});
  }

  /// The least covered face decides whether any gas may be in a cell.
  float mostCovered(const Vec3i& cell) const {
    float least = 1;
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        Vec3i face = cell;
        face[axis] += side;
        least = std::min(least, lattice_.covered.component(axis)(face.x, face.y, face.z));
      }
    return least;
  }

  float openSum(const Vec3i& cell) const {
    float sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i upper = cell;
      ++upper[axis];
      const Grid3<float>& open = stamp_.openShare.component(axis);
      sum += open(cell.x, cell.y, cell.z) + open(upper.x, upper.y, upper.z);
    }
    return sum;
  }

  CellGas gasOf(const Vec3i& cell) const { return lattice_.gas(cell.x, cell.y, cell.z); }
  Vec3d pointOf(const Vec3i& cell) const {
    if (gasOf(cell) == CellGas::atCentre) return surfaces_.box.centre(cell);
    for (const GasPoint& point : lattice_.points[rowNumber(cell.y, cell.z)])
      if (point.i == cell.x) return point.place;
    return surfaces_.box.centre(cell);
  }

  /// Whether gas sees through a face: from one cell's gas to the other's, or straight out of the box.
  bool isPassable(int axis, const Vec3i& face) const {
    Vec3i lower = face;
    --lower[axis];
    const bool hasLower = inBox(lower), hasUpper = inBox(face);
    const CellGas below = hasLower ? gasOf(lower) : CellGas::atCentre,
                  above = hasUpper ? gasOf(face) : CellGas::atCentre;
    if (below == CellGas::none || above == CellGas::none) return false;
    if (below == CellGas::atCentre && above == CellGas::atCentre)
      return !lattice_.crossed[axis](face.x, face.y, face.z);
    if (hasLower && hasUpper) return surfaces_.seesAcross(pointOf(lower), pointOf(face), lower, face);
    const Vec3i& cell = hasLower ? lower : face;
    Vec3d out = pointOf(cell);
    out[axis] = face[axis];
    return surfaces_.seesAcross(pointOf(cell), out, cell, cell);
  }

  bool isBoxWall(int axis, const Vec3i& face) const {
    return (face[axis] == 0 && isWall(faces_[lowerFaceOf(axis)])) ||
           (face[axis] == n_[axis] && isWall(faces_[upperFaceOf(axis)]));
  }

  float shareOf(int axis, const Vec3i& face) const {
    if (isBoxWall(axis, face)) return 0;
    const float open = 1 - std::min(1.0f, lattice_.covered.component(axis)(face.x, face.y, face.z));
    return open >= smallestShare && isPassable(axis, face) ? open : 0;
  }

  const Faces& faces_;
  const Surfaces& surfaces_;
  Vec3i n_;
  SolidLattice& lattice_;
  SolidStamp& stamp_;
};

/// Two faces that are one because the box is periodic let through what both do.
void joinPeriodicFaces(const FluidSettings& settings, MacVelocity& openShare) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!isPeriodic(settings.faces, axis)) continue;
    Grid3<float>& open = openShare.component(axis);
    const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
    const std::int64_t far = (open.size[axis] - 1) * open.stride(axis);
    for (int q = 0; q < open.size[c]; ++q)
      for (int p = 0; p < open.size[b]; ++p) {
        float& lower = open.values[p * open.stride(b) + q * open.stride(c)];
        lower = *(&lower + far) = std::min(lower, *(&lower + far));
      }
  }
}
}  // namespace

RowSet RowSet::grown(const Faces& faces, int times) const {
  RowSet out = *this;
  for (int n = 0; n < times; ++n) {
    const RowSet before = out;
    const auto addAround = [&](int j, int k) {
      if (faces[2] == FaceKind::periodic) j = (j + cells_.y) % cells_.y;
      if (faces[4] == FaceKind::periodic) k = (k + cells_.z) % cells_.z;
      out.add(j, k);
    };
    for (int k = 0; k < cells_.z; ++k)
      for (int j = 0; j < cells_.y; ++j)
        if (before.contains(j, k))
          for (int dk = -1; dk <= 1; ++dk)
            for (int dj = -1; dj <= 1; ++dj) addAround(j + dj, k + dk);
  }
  return out;
}

SolidLattice::SolidLattice(const FluidSettings& s)
    : covered(s.cells, s.corner, s.cellSize),
      centreInside(cellGrid<std::uint8_t>(s, 0)),
      gas(cellGrid(s, CellGas::atCentre)),
      sliver(cellGrid<std::uint8_t>(s, 0)),
      points(static_cast<std::size_t>(s.cells.y) * s.cells.z) {
  for (int axis = 0; axis < 3; ++axis) {
    const Grid3<float>& like = covered.component(axis);
    crossed[axis] = Grid3<std::uint8_t>(like.size, like.origin, like.cellSize, 0);
  }
}

void SolidLattice::add(const BodyCut& cut, const LatticeBox& box, RowSet& touched) {
  for (int axis = 0; axis < 3; ++axis)
    for (const FaceCut& face : cut.faces[axis]) {
      const std::int64_t index = box.faceIndex(axis, face.face);
      covered.component(axis).values[index] += static_cast<float>(face.covered);
      if (face.crossed) crossed[axis].values[index] = 1;
      touched.add(face.face.y, face.face.z);
      touched.add(face.face.y - (axis == 1), face.face.z - (axis == 2));
    }
  for (const Vec3i& cell : cut.insideCentres) {
    centreInside(cell.x, cell.y, cell.z) = 1;
    touched.add(cell.y, cell.z);
  }
}

namespace {
template <class T>
void copyCells(const Grid3<T>& from, int j, int k, Grid3<T>& to) {
  std::copy_n(from.values.begin() + from.index(0, j, k), from.size.x, to.values.begin() + to.index(0, j, k));
}
/// The samples of a row, and those that end the box beyond it.
template <class T>
void copyFaces(const Grid3<T>& from, int axis, Vec3i place, Grid3<T>& to) {
  copyCells(from, place.y, place.z, to);
  if (axis == 0) return;
  ++place[axis];
  if (place[axis] + 1 == from.size[axis]) copyCells(from, place.y, place.z, to);
}
}  // namespace

void SolidLattice::copyRow(const SolidLattice& from, int j, int k) {
  for (int axis = 0; axis < 3; ++axis) {
    copyFaces(from.covered.component(axis), axis, {0, j, k}, covered.component(axis));
    copyFaces(from.crossed[axis], axis, {0, j, k}, crossed[axis]);
  }
  copyCells(from.centreInside, j, k, centreInside);
  copyCells(from.gas, j, k, gas);
  copyCells(from.sliver, j, k, sliver);
  const std::size_t row = j + static_cast<std::size_t>(gas.size.y) * k;
  points[row] = from.points[row];
}

void evaluateRows(const FluidSettings& settings, const Surfaces& surfaces, const RowSet& touched, SolidLattice& lattice,
                  SolidStamp& stamp) {
  RowEvaluation rows(settings, surfaces, lattice, stamp);
  const RowSet near = touched.grown(settings.faces, 1), further = near.grown(settings.faces, 1);
  const RowSet all = further.grown(settings.faces, rowsOfInfluence - 2);
  near.forEach([&](int j, int k) { rows.findGas(j, k); });
  all.forEach([&](int j, int k) { rows.openFaces(j, k); });
  joinPeriodicFaces(settings, stamp.openShare);
  further.forEach([&](int j, int k) { rows.findSlivers(j, k); });
  all.forEach([&](int j, int k) { rows.closeSlivers(j, k); });
  joinPeriodicFaces(settings, stamp.openShare);
  all.forEach([&](int j, int k) { rows.findSolidCells(j, k); });
}

}  // namespace brisance
