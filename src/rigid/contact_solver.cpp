#include "rigid/contact_solver.h"

namespace brisance {
namespace {

constexpr int mostSweeps = 80;
constexpr double settled = 1e-8;      // change of a speed in a sweep [m/s] below which more sweeps change nothing
constexpr double openingShare = 0.2;  // of an overlap that one step opens
constexpr double openingSpeed = 1.0;  // at most [m/s]

double massAlong(const Mover& a, const Mover& b, const Vec3d& armA, const Vec3d& armB, const Vec3d& axis) {
  const Vec3d turnA = cross(armA, axis), turnB = cross(armB, axis);
  const double k =
      a.inverseMass + b.inverseMass + dot(turnA, a.inverseInertia * turnA) + dot(turnB, b.inverseInertia * turnB);
  return k > 0 ? 1 / k : 0;
}

}  // namespace

ContactSolver::ContactSolver(std::vector<Mover>& movers, std::span<const std::uint32_t> number,
                             std::span<const ContactPoint> contacts, std::span<const double> skin,
                             const Contacts& settings, double dt)
    : movers_(movers), settings_(settings), dt_(dt) {
  rows_.reserve(contacts.size());
  for (std::size_t n = 0; n < contacts.size(); ++n) {
    const ContactPoint& contact = contacts[n];
    Row row;
    row.a = number[contact.a], row.b = number[contact.b];
    row.place = contact.place, row.normal = contact.normal;
    const Vec3d other = std::abs(row.normal.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    row.tangents[0] = normalized(cross(other, row.normal));
    row.tangents[1] = cross(row.normal, row.tangents[0]);
    row.gap = contact.gap - skin[n];
    row.slack = 2 * skin[n];
    arms(row);
    row.meeting = speed(row, row.normal);
    rows_.push_back(row);
  }
}

/// Both arms end in one place: then what one mover gains in angular momentum the other one loses.
void ContactSolver::arms(Row& row) const {
  const Mover &a = movers_[row.a], &b = movers_[row.b];
  row.armA = row.place - a.place;
  row.armB = row.place - b.place;
  row.share = massAlong(a, b, row.armA, row.armB, row.normal);
  for (int k = 0; k < 2; ++k) row.tangentShare[k] = massAlong(a, b, row.armA, row.armB, row.tangents[k]);
}

double ContactSolver::speed(const Row& row, const Vec3d& axis) const {
  return dot(velocityAt(movers_[row.b], row.armB) - velocityAt(movers_[row.a], row.armA), axis);
}

void ContactSolver::apply(const Row& row, const Vec3d& impulse) {
  Mover &a = movers_[row.a], &b = movers_[row.b];
  a.velocity -= impulse * a.inverseMass;
  a.spin -= a.inverseInertia * cross(row.armA, impulse);
  b.velocity += impulse * b.inverseMass;
  b.spin += b.inverseInertia * cross(row.armB, impulse);
}

/// Pushes until the gap opens at `least` [m/s] or more; never pulls in sum. Returns the change of speed.
double ContactSolver::push(Row& row, double least) {
  const double before = row.pushes;
  row.pushes = std::max(0.0, before + row.share * (least - speed(row, row.normal)));
  const double change = row.pushes - before;
  if (change != 0) apply(row, row.normal * change);
  return row.share > 0 ? std::abs(change) / row.share : 0;
}

void ContactSolver::rub(Row& row) {
  const double most = settings_.friction * row.pushes;
  double wanted[2];
  for (int k = 0; k < 2; ++k) wanted[k] = row.rubs[k] - row.tangentShare[k] * speed(row, row.tangents[k]);
  const double size = std::sqrt(wanted[0] * wanted[0] + wanted[1] * wanted[1]);
  const double scale = size > most ? most / size : 1;
  Vec3d change;
  for (int k = 0; k < 2; ++k) {
    change += row.tangents[k] * (wanted[k] * scale - row.rubs[k]);
    row.rubs[k] = wanted[k] * scale;
  }
  if (!(change == Vec3d{})) apply(row, change);
}

/// There and back over all contacts until speeds settle.
void ContactSolver::sweep(double opening) {
  for (int n = 0; n < mostSweeps; ++n) {
    double largest = 0;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      Row& row = rows_[n % 2 == 0 ? k : rows_.size() - 1 - k];
      const double overlap = std::max(0.0, -row.gap - row.slack);
      const double least = row.gap > 0 ? -row.gap / dt_ : std::min(opening * overlap / dt_, openingSpeed);
      largest = std::max(largest, push(row, least));
      rub(row);
    }
    if (largest < settled) return;
  }
}

void ContactSolver::begin(std::size_t contact, const Vec3d& impulse) {
  Row& row = rows_[contact];
  row.pushes = std::max(0.0, dot(impulse, row.normal));
  for (int k = 0; k < 2; ++k) row.rubs[k] = dot(impulse, row.tangents[k]);
  apply(row, this->impulse(contact));
}

void ContactSolver::solve() { sweep(openingShare); }

void ContactSolver::relax() {
  for (Row& row : rows_) {
    const Mover &a = movers_[row.a], &b = movers_[row.b];
    // How far the place of contact went with either mover.
    const Vec3d movedA = a.place + rotate(a.turned, row.armA) - row.place;
    const Vec3d movedB = b.place + rotate(b.turned, row.armB) - row.place;
    row.gap += dot(movedB - movedA, row.normal);
  }
  for (Row& row : rows_) arms(row);
  sweep(0);
}

void ContactSolver::bounce(double leastSpeed) {
  constexpr int passes = 4;  // several contacts of one body share its bounce
  if (settings_.restitution == 0) return;
  for (int n = 0; n < passes; ++n)
    for (Row& row : rows_)
      if (row.pushes > 0 && row.meeting < -leastSpeed) push(row, -settings_.restitution * row.meeting);
}

Vec3d ContactSolver::impulse(std::size_t contact) const {
  const Row& row = rows_[contact];
  return row.normal * row.pushes + row.tangents[0] * row.rubs[0] + row.tangents[1] * row.rubs[1];
}

bool ContactSolver::touches(std::size_t contact) const {
  const Row& row = rows_[contact];
  return row.gap < row.slack || !(impulse(contact) == Vec3d{});
}

double ContactSolver::strike(std::size_t contact) const {
  const Row& row = rows_[contact];
  const double meeting = std::max(0.0, -row.meeting);
  const bool meets = row.gap < 2 * meeting * dt_;  // in this step, or, when relax() looks ahead, in the next
  return std::max(length(impulse(contact)), meets ? (1 + settings_.restitution) * row.share * meeting : 0);
}

}  // namespace brisance
