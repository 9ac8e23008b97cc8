// From what bodies cut of the lattice to what each face lets through, row by row (rows along x).
#pragma once

#include "base/parallel.h"
#include "fluid/fluid_state.h"
#include "fluid/gas_points.h"

namespace brisance {

/// A set of rows, by j + ny k.
class RowSet {
 public:
  explicit RowSet(const Vec3i& cells) : cells_(cells), has_(static_cast<std::size_t>(cells.y) * cells.z, 0) {}
  void add(int j, int k) {
    if (j >= 0 && k >= 0 && j < cells_.y && k < cells_.z) has_[j + static_cast<std::size_t>(cells_.y) * k] = 1;
  }
  bool contains(int j, int k) const { return has_[j + static_cast<std::size_t>(cells_.y) * k]; }
  bool empty() const { return std::find(has_.begin(), has_.end(), 1) == has_.end(); }
  /// With all rows beside them, across periodic faces too.
  RowSet grown(const Faces& faces, int times) const;
  /// Calls work(j, k) for each row, on all threads.
  template <class Work>
  void forEach(const Work& work) const {
    forEachPlane([&](int k) {
      for (int j = 0; j < cells_.y; ++j)
        if (contains(j, k)) work(j, k);
    });
  }
  /// Calls work(k) for all planes of rows, on all threads.
  template <class Work>
  void forEachPlane(const Work& work) const {
    parallelFor(0, cells_.z, 1, [&](std::int64_t first, std::int64_t last) {
      for (int k = static_cast<int>(first); k < last; ++k) work(k);
    });
  }

 private:
  Vec3i cells_;
  std::vector<std::uint8_t> has_;
};

/// What is known of each face and cell. `covered` and `crossed` add up over bodies; the rest follows from them.
struct SolidLattice {
  MacVelocity covered;  ///< share of the face in bodies, 0 or more
  std::array<Grid3<std::uint8_t>, 3> crossed;
  Grid3<std::uint8_t> centreInside;
  Grid3<CellGas> gas;
  Grid3<std::uint8_t> sliver;                 ///< 1: so little of the cell is open that it counts as solid
  std::vector<std::vector<GasPoint>> points;  ///< by row, ascending

  explicit SolidLattice(const FluidSettings& settings);
  void add(const BodyCut& cut, const LatticeBox& box, RowSet& touched);
  void copyRow(const SolidLattice& from, int j, int k);
};

/// Works out openShare, inside and cutRows of `stamp` for all rows that the touched ones may concern. `lattice` and
/// `stamp` hold in other rows what they held before.
void evaluateRows(const FluidSettings& settings, const Surfaces& surfaces, const RowSet& touched, SolidLattice& lattice,
                  SolidStamp& stamp);
/// How far from a touched row a value may change.
constexpr int rowsOfInfluence = 3;

}  // namespace brisance
