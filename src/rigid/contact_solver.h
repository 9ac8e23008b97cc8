// Impulses that keep bodies from passing through one another.
//
// Bodies as points of mass with inertia, contacts as inequalities: the speed at which a gap closes, times the step, is
// at most the gap; what pushes is never a pull; friction is at most its coefficient times what pushes. Solved by
// projected Gauss-Seidel (Catto 2005, "Iterative dynamics with temporal coherence"), in fixed order.
#pragma once

#include <span>

#include "rigid/contact_manifold.h"
#include "rigid/rigid_settings.h"

namespace brisance {

/// What moves as one: a body, or bodies that are still bonded.
struct Mover {
  Vec3d place, velocity, spin;       ///< of the centre of mass [m, m/s, 1/s]
  double inverseMass = 0;            ///< [1/kg]; 0: immovable
  Mat3 inverseInertia = Mat3{} * 0;  ///< [1/(kg m2)] in the world's axes
  Quaternion turned;                 ///< since the solver was made
};
inline Vec3d velocityAt(const Mover& mover, const Vec3d& arm) { return mover.velocity + cross(mover.spin, arm); }

class ContactSolver {
 public:
  /// `number` is that of each body's mover; `skin` [m] per contact: the gap at which bodies come to rest. Overlaps up
  /// to as much are left alone: what fits between two others exactly is not wedged there.
  ContactSolver(std::vector<Mover>& movers, std::span<const std::uint32_t> number,
                std::span<const ContactPoint> contacts, std::span<const double> skin, const Contacts& settings,
                double dt);

  /// Begins with an impulse on b [kg m/s] instead of none: the nearer to the answer, the fewer sweeps.
  void begin(std::size_t contact, const Vec3d& impulse);
  /// Velocities that leave every gap at its skin or more after dt, and open overlaps a little.
  void solve();
  /// After movers went to their new places with those velocities: takes back the speed that opened overlaps.
  void relax();
  /// Bodies that met faster than `leastSpeed` [m/s] part at the restitution's share of the speed they met with.
  void bounce(double leastSpeed);

  std::size_t size() const { return rows_.size(); }
  /// Impulse on b [kg m/s], so far.
  Vec3d impulse(std::size_t contact) const;
  /// Whether the two press each other, or could if they moved by no more than bodies rest apart.
  bool touches(std::size_t contact) const;
  /// At most how hard [kg m/s] the two strike each other, with what the bounce adds.
  double strike(std::size_t contact) const;

 private:
  struct Row {
    std::uint32_t a = 0, b = 0;
    Vec3d place, normal, tangents[2];
    Vec3d armA, armB;
    double share = 0, tangentShare[2]{};  ///< impulse per speed along the axis [kg]
    double gap = 0;                       ///< beyond the skin [m]
    double slack = 0;                     ///< gaps down to minus this are left as they are [m]
    double pushes = 0, rubs[2]{};         ///< impulses [kg m/s]
    double meeting = 0;                   ///< speed along the normal before anything was solved [m/s]
  };
  void arms(Row& row) const;
  double speed(const Row& row, const Vec3d& axis) const;
  void apply(const Row& row, const Vec3d& impulse);
  double push(Row& row, double least);
  void rub(Row& row);
  void sweep(double openingShare);

  std::vector<Mover>& movers_;
  std::vector<Row> rows_;
  Contacts settings_;
  double dt_;
};

}  // namespace brisance
