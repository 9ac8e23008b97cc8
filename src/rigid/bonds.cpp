#include "rigid/bonds.h"

#include "mesh/disjoint_sets.h"

namespace brisance {
namespace {

/// A small move of a body: its centre's way, and its turn.
struct Move {
  Vec3d way, turn;
};
using Moves = std::vector<Move>;

/// A bond as a beam between two bodies, in the world.
struct Beam {
  std::uint32_t a = 0, b = 0;
  Vec3d armA, armB, normal;
  double stretch = 0, bend = 0;  ///< how stiff
};

/// Stiffness of a square beam of the bond's area, as long as the centres are apart; of a material of modulus one.
Beam beamOf(const RigidBodies& bodies, const BodyBond& bond) {
  constexpr double squareSection = 1.0 / 12;  // second moment of a square of area one
  const Mat3 turned = rotationMatrix(bodies.orientation[bond.a]);
  const Vec3d place = bodies.position[bond.a] + turned * bond.place;
  Beam beam{bond.a, bond.b, place - bodies.position[bond.a], place - bodies.position[bond.b], turned * bond.normal,
            0,      0};
  const double apart = length(bodies.position[bond.b] - bodies.position[bond.a]);
  beam.stretch = bond.area / std::max(apart, std::sqrt(bond.area));
  beam.bend = beam.stretch * bond.area * squareSection;
  return beam;
}

std::vector<Beam> beamsOf(const RigidBodies& bodies) {
  std::vector<Beam> beams;
  for (std::size_t n = 0; n < bodies.bonds.size(); ++n) {
    beams.push_back(beamOf(bodies, bodies.bonds[n]));
    if (!bodies.holds[n]) beams.back().stretch = beams.back().bend = 0;
  }
  return beams;
}

/// What a beam pulls its second body back with, at the beam's place.
Load pullOf(const Beam& beam, const Moves& moves) {
  const Move &a = moves[beam.a], &b = moves[beam.b];
  const Vec3d apart = b.way + cross(b.turn, beam.armB) - a.way - cross(a.turn, beam.armA);
  return {apart * -beam.stretch, (b.turn - a.turn) * -beam.bend};
}

/// Stiffness times moves.
Moves resist(const std::vector<Beam>& beams, const Moves& moves) {
  Moves forces(moves.size());
  for (const Beam& beam : beams) {
    const Load pull = pullOf(beam, moves);
    forces[beam.b].way -= pull.push;
    forces[beam.b].turn -= pull.twist + cross(beam.armB, pull.push);
    forces[beam.a].way += pull.push;
    forces[beam.a].turn += pull.twist + cross(beam.armA, pull.push);
  }
  return forces;
}

/// Diagonal of the stiffness; 1 for bodies without beams.
Moves diagonalOf(const std::vector<Beam>& beams, std::size_t bodies) {
  Moves diagonal(bodies);
  for (const Beam& beam : beams)
    for (const auto& [body, arm] : {std::pair{beam.a, beam.armA}, std::pair{beam.b, beam.armB}}) {
      const double s = beam.stretch, square = dot(arm, arm);
      diagonal[body].way += Vec3d(s, s, s);
      for (int k = 0; k < 3; ++k) diagonal[body].turn[k] += beam.bend + s * (square - arm[k] * arm[k]);
    }
  for (Move& d : diagonal)
    for (int k = 0; k < 3; ++k) {
      if (d.way[k] == 0) d.way[k] = 1;
      if (d.turn[k] == 0) d.turn[k] = 1;
    }
  return diagonal;
}

double product(const Moves& p, const Moves& q) {
  double sum = 0;
  for (std::size_t n = 0; n < p.size(); ++n) sum += dot(p[n].way, q[n].way) + dot(p[n].turn, q[n].turn);
  return sum;
}

void addTimes(Moves& to, double factor, const Moves& what) {
  for (std::size_t n = 0; n < to.size(); ++n) {
    to[n].way += what[n].way * factor;
    to[n].turn += what[n].turn * factor;
  }
}

Moves divided(const Moves& p, const Moves& by) {
  Moves q(p.size());
  for (std::size_t n = 0; n < p.size(); ++n)
    for (int k = 0; k < 3; ++k) {
      q[n].way[k] = p[n].way[k] / by[n].way[k];
      q[n].turn[k] = p[n].turn[k] / by[n].turn[k];
    }
  return q;
}

/// Conjugate gradients, preconditioned by the diagonal: moves at which the beams hold the loads. A group may move as a
/// whole, which no beam resists and no load asks for.
Moves yield(const std::vector<Beam>& beams, const Moves& loads) {
  constexpr double accuracy = 1e-7;
  constexpr int mostSteps = 2000;
  const Moves diagonal = diagonalOf(beams, loads.size());
  Moves moves(loads.size()), rest = loads, eased = divided(rest, diagonal), way = eased;
  double left = product(rest, eased);
  const double enough = left * accuracy * accuracy;
  for (int n = 0; n < mostSteps && left > enough; ++n) {
    const Moves forces = resist(beams, way);
    const double stiffness = product(way, forces);
    if (!(stiffness > 0)) break;
    addTimes(moves, left / stiffness, way);
    addTimes(rest, -left / stiffness, forces);
    eased = divided(rest, diagonal);
    const double next = product(rest, eased), share = next / left;
    for (std::size_t k = 0; k < way.size(); ++k)
      way[k] = {eased[k].way + way[k].way * share, eased[k].turn + way[k].turn * share};
    left = next;
  }
  return moves;
}

/// Tension, shear and bending over a bond of unit time [Pa s]; to be pressed together is no strain.
double strain(const BodyBond& bond, const Vec3d& normal, const Load& load) {
  constexpr double edgeOfSquare = 6;  // bending moment over area^1.5 to stress at the edge
  const double along = dot(load.push, normal);
  // A bond that pulls its second body back, against the normal, is in tension.
  const Vec3d across = load.push - normal * along;
  const double tension = std::max(0.0, -along);
  const double stress = std::sqrt(tension * tension + dot(across, across)) / bond.area;
  return stress + edgeOfSquare * length(load.twist) / (bond.area * std::sqrt(bond.area));
}

/// More than any bond can have to carry: all loads through the smallest one, with the longest lever.
bool mayBreak(const RigidBodies& bodies, const std::vector<Beam>& beams, std::span<const Load> loads, double dt) {
  constexpr double leverFactor = 6;
  double push = 0, twist = 0, lever = 0;
  for (const Beam& beam : beams) lever += length(beam.armA) + length(beam.armB);
  for (const Load& load : loads) push += length(load.push), twist += length(load.twist);
  for (std::size_t n = 0; n < bodies.bonds.size(); ++n) {
    const BodyBond& bond = bodies.bonds[n];
    const double most = push / bond.area + leverFactor * (twist + push * lever) / (bond.area * std::sqrt(bond.area));
    if (bodies.holds[n] && most > bond.strength * dt) return true;
  }
  return false;
}

}  // namespace

std::vector<std::uint32_t> bondedGroups(const RigidBodies& bodies) {
  DisjointSets sets(bodies.size());
  for (std::size_t n = 0; n < bodies.bonds.size(); ++n)
    if (bodies.holds[n]) sets.join(bodies.bonds[n].a, bodies.bonds[n].b);
  constexpr std::uint32_t none = 0xFFFFFFFFu;
  std::vector<std::uint32_t> numberOf(bodies.size(), none), group(bodies.size());
  std::uint32_t count = 0;
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    std::uint32_t& number = numberOf[sets.root(b)];
    if (number == none) number = count++;
    group[b] = number;
  }
  return group;
}

std::vector<Load> bondLoads(const RigidBodies& bodies, std::span<const Load> loads) {
  const std::vector<Beam> beams = beamsOf(bodies);
  Moves wanted;
  for (const Load& load : loads) wanted.push_back({load.push, load.twist});
  const Moves moves = yield(beams, wanted);
  std::vector<Load> passed;
  passed.reserve(beams.size());
  for (const Beam& beam : beams) passed.push_back(pullOf(beam, moves));
  return passed;
}

bool loosenBonds(RigidBodies& bodies, std::span<const Load> loads, double dt, Overloaded which) {
  constexpr double asBad = 0.99;  // what is alike by symmetry breaks together
  const std::vector<Beam> beams = beamsOf(bodies);
  if (!mayBreak(bodies, beams, loads, dt)) return false;
  const std::vector<Load> passed = bondLoads(bodies, loads);
  const std::vector<std::uint32_t> group = bondedGroups(bodies);
  std::vector<double> overload(bodies.bonds.size(), 0), worst(bodies.size(), 0);
  for (std::size_t n = 0; n < bodies.bonds.size(); ++n) {
    if (!bodies.holds[n]) continue;
    overload[n] = strain(bodies.bonds[n], beams[n].normal, passed[n]) / (bodies.bonds[n].strength * dt);
    double& most = worst[group[bodies.bonds[n].a]];
    most = std::max(most, overload[n]);
  }
  bool any = false;
  for (std::size_t n = 0; n < bodies.bonds.size(); ++n) {
    const double least = which == Overloaded::all ? 1 : std::max(1.0, asBad * worst[group[bodies.bonds[n].a]]);
    if (!(overload[n] > 1 && overload[n] >= least)) continue;
    bodies.holds[n] = 0;
    any = true;
  }
  return any;
}

}  // namespace brisance
