// Surfaces near a cell, and whether they stand between two points.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fluid/lattice_cut.h"

namespace brisance {

/// Triangles by the cells that they touch.
class TriangleBins {
 public:
  TriangleBins() = default;
  TriangleBins(const LatticeBox& box, std::vector<Corners> triangles);

  template <class Visit>
  void forCell(std::int64_t cell, const Visit& visit) const {
    auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry{cell, 0});
    for (; entry != entries_.end() && entry->cell == cell; ++entry) visit(triangles_[entry->triangle]);
  }

 private:
  struct Entry {
    std::int64_t cell;
    std::uint32_t triangle;
    friend auto operator<=>(const Entry&, const Entry&) = default;  // NOLINT(modernize-use-nullptr)
  };
  std::vector<Corners> triangles_;
  std::vector<Entry> entries_;
};

/// Where a segment from p (0) to q (1) first meets a triangle; 2 where it does not. Surfaces that it merely touches, or
/// passes within rounding, count: of two triangles that share an edge at least one is met.
double meets(const Vec3d& p, const Vec3d& q, const Corners& triangle);

/// Bins of several sets of bodies, asked together.
struct Surfaces {
  const LatticeBox& box;
  std::array<const TriangleBins*, 2> bins{};

  /// The first meeting on a segment that lies in two neighbouring cells, as above.
  double firstMeeting(const Vec3d& p, const Vec3d& q, const Vec3i& cell, const Vec3i& neighbour) const;
  bool seesAcross(const Vec3d& p, const Vec3d& q, const Vec3i& cell, const Vec3i& neighbour) const {
    return firstMeeting(p, q, cell, neighbour) > 1;
  }
};

}  // namespace brisance
