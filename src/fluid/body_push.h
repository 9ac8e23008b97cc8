// Pressure pushes bodies while it is solved for: a body that gives way changes what the gas must do, and so belongs
// into the operator (Batty, Bertails & Bridson 2007, section 4). Taken apart, the two would push each other ever harder
// wherever a body is lighter than the gas it moves.
//
// Legend: h cell size, rho density of the gas, m mass, J inertia; a body closes the share s_f of face f; e_f the face's
// axis, r_f its place from the centre of mass. In a cell, area = sum of s_f e_f over its faces (upper ones counted +,
// lower -), moment = sum of s_f r_f x e_f. With x = dt p / rho, pressure gives the body in one step
//   dv = (rho h^2 / m) sum x area,   dw = rho h^2 J^-1 sum x moment
// and the body gives each cell the outflow h^2 (area . dv + moment . dw): the same coefficients, so that what is added
// to the operator is symmetric and not negative.
#pragma once

#include "fluid/cell_field.h"
#include "fluid/fluid_state.h"

namespace brisance {

/// A change of a body's motion.
struct MotionChange {
  Vec3d velocity, angularVelocity;
};

/// The cells in which gas touches one body.
struct BodyContact {
  std::int64_t cell;    ///< place in a CellField
  std::int32_t number;  ///< in whatever list of cells the solver keeps
  Vec3d area, moment;
};

class BodyPush {
 public:
  BodyPush() = default;
  /// Of the bodies that are free to move; `density` [kg/m3] of the gas.
  BodyPush(const SolidStamp& solid, const CellLayout& layout, double density);

  bool empty() const { return contacts_.empty(); }
  /// By cell: contacts in ascending order of cells, body after body.
  std::vector<BodyContact>& contacts() { return contacts_; }
  /// By region of gas: it pushes a body as a whole, so that no source in it is too much.
  const std::vector<std::uint8_t>& yielding() const { return yielding_; }
  /// Whether a region has anything of a body that gives way.
  bool touches(int region) const { return touched_[region]; }

  /// How x, given by at(contact), changes the motion of each body.
  template <class At>
  std::vector<MotionChange> response(const At& at) const {
    std::vector<MotionChange> changes;
    for (const FreeBody& body : bodies_) {
      Vec3d push, turn;
      for (std::size_t n = body.first; n < body.end; ++n) {
        const double x = at(contacts_[n]);
        push += contacts_[n].area * x;
        turn += contacts_[n].moment * x;
      }
      changes.push_back({push * body.perPush, body.perTurn * turn});
    }
    return changes;
  }
  /// Calls add(contact, value) with h (area . dv + moment . dw): what the operator has more.
  template <class Add>
  void addOutflow(const std::vector<MotionChange>& changes, const Add& add) const {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (std::size_t n = bodies_[b].first; n < bodies_[b].end; ++n)
        add(contacts_[n], cellSize_ * (dot(contacts_[n].area, changes[b].velocity) +
                                       dot(contacts_[n].moment, changes[b].angularVelocity)));
  }
  /// Moves the bodies of `gas` by what x does to them, and the gas on the faces that they close.
  void apply(const CellField& x, FluidState& gas) const;

 private:
  struct FreeBody {
    int body;  ///< in SolidStamp::bodies
    std::size_t first, end;
    double perPush;  ///< rho h^2 / m
    Mat3 perTurn;    ///< rho h^2 J^-1
  };
  double cellSize_ = 0;
  std::vector<FreeBody> bodies_;
  std::vector<BodyContact> contacts_;
  std::vector<std::uint8_t> yielding_, touched_;  // by region
};

}  // namespace brisance
