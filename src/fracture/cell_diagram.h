// Space divided among seeds: a power diagram (of equal weights: a Voronoi diagram), as the dual of the triangulation of
// its seeds.
#pragma once

#include <span>

#include "fracture/power_triangulation.h"

namespace brisance {

constexpr std::uint32_t noCell = 0xFFFFFFFFu;

class CellDiagram {
 public:
  /// Four ghost seeds are added, far enough outside that the box of the lattice lies in cells of real seeds alone.
  explicit CellDiagram(std::vector<WeightedSeed> seeds);

  std::uint32_t cellCount() const { return cellCount_; }
  bool isGhost(std::uint32_t seed) const { return seed >= cellCount_; }
  const std::vector<WeightedSeed>& seeds() const { return seeds_; }  ///< the ghosts last
  const std::vector<Tetrahedron>& tetrahedra() const { return tetrahedra_; }
  /// Cells that share a face with this one, rising; none if it is hidden.
  std::span<const std::uint32_t> neighbours(std::uint32_t cell) const {
    return {targets_.data() + first_[cell], first_[cell + 1] - first_[cell]};
  }

  /// The power distance of a vertex from a cell's seed [vertex step x seed step], less what all cells share.
  std::int64_t power(std::uint32_t cell, const Vec3l& vertex) const {
    return constant_[cell] - dot(twice_[cell], vertex);
  }
  /// The cell of least power distance, by walking over neighbours from any cell; noCell starts anywhere.
  std::uint32_t cellOf(const Vec3l& vertex, std::uint32_t start) const;

  /// Where the four cells of a tetrahedron's seeds meet [seed steps].
  Vec3d meetingPoint(const Tetrahedron& tetrahedron) const;

 private:
  void findNeighbours();

  std::uint32_t cellCount_;
  std::vector<WeightedSeed> seeds_;
  std::vector<Tetrahedron> tetrahedra_;
  std::vector<Vec3l> twice_;            ///< twice a seed's place
  std::vector<std::int64_t> constant_;  ///< its square less its weight
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> targets_;
  std::uint32_t visible_ = noCell;  ///< a cell that is not hidden
};

}  // namespace brisance
