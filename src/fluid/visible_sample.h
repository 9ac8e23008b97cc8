// A scalar seen from one cell: nothing from behind a closed face.
#pragma once

#include "fluid/fluid_state.h"
#include "fluid/padded_grid.h"

namespace brisance {

class VisibleSampler {
 public:
  VisibleSampler(const SolidStamp& solid, const Faces& faces, const PaddedGrid& scalar)
      : solid_(solid), faces_(faces), scalar_(scalar) {}

  /// The scalar at `shift` [cells] from the centre of a cell. The way there leads along one axis after the other and
  /// stops short of closed faces; values are mixed of the cells around its end that open faces join to it.
  float at(const Vec3i& cell, const Vec3f& shift) const;

 private:
  struct Place {
    Vec3i cell;   ///< -1 or the number of cells: beyond an open face of the box
    Vec3f share;  ///< 0 .. 1 across the cell
    bool outside = false;
  };
  Place walk(const Vec3i& cell, const Vec3f& shift) const;
  float mixAround(const Place& place) const;
  /// The cell beside a cell, around a periodic box; false where their face is closed.
  bool step(Vec3i& cell, int axis, bool forward) const;
  bool contains(const Vec3i& cell) const { return solid_.inside.contains(cell.x, cell.y, cell.z); }
  float value(const Vec3i& cell) const { return scalar_.values(cell.x + 1, cell.y + 1, cell.z + 1); }

  const SolidStamp& solid_;
  const Faces& faces_;
  const PaddedGrid& scalar_;
};

}  // namespace brisance
