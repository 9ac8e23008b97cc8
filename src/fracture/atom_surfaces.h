// Which parts of the border of cells belong together.
#pragma once

#include "fracture/cell_atoms.h"
#include "mesh/disjoint_sets.h"

namespace brisance {

/// The border of a cell's part inside the body falls into closed sheets. A sheet of positive volume is the outside of
/// an atom, one of negative volume a cavity in one of them.
class AtomSurfaces {
 public:
  explicit AtomSurfaces(const CellComplex& complex);
  /// All but the contacts.
  CellAtoms atoms();

 private:
  struct Sheet {
    std::uint32_t cell = noCell;
    double volume = 0;
    Vec3d moment;     ///< volume times centroid
    Vec3d somewhere;  ///< one of its vertices
    int atom = -1;
  };

  /// A vertex lies in up to four cells, and in each on another sheet.
  std::uint32_t slot(std::uint32_t vertex, std::uint32_t cell) const;
  std::uint32_t sheetOf(std::uint32_t vertex, std::uint32_t cell);
  void joinAll();
  void measureAll();
  void measure(std::uint32_t sheet, std::uint32_t cell, const Triangle& triangle, double sense);
  void nameAtoms(CellAtoms& atoms);
  void placeCavities(CellAtoms& atoms);
  std::vector<std::vector<double>> anglesAbout(const std::vector<std::vector<std::uint32_t>>& cavitiesOf,
                                               const std::vector<std::vector<int>>& atomsOf);
  template <class Visit>
  void forEachTriangle(const Visit& visit) const;

  const CellComplex& complex_;
  DisjointSets sets_;
  std::vector<std::uint32_t> sheetOfRoot_;
  std::vector<Sheet> sheets_;
  Vec3d middle_;  ///< volumes are measured about it
};

}  // namespace brisance
