#include "base/check.h"
#include "mesh/edge_uses.h"
#include "mesh/mesh_patient.h"
#include "mesh/mesh_topology.h"

namespace brisance {
namespace {

constexpr double clearlyApart = 1e-9;  // of a quarter turn, between two triangles at an edge

/// An edge of more than two triangles.
struct Tangle {
  std::uint32_t low = 0;
  std::vector<EdgeUse> uses;
};

/// A use of a tangled edge, and where around it its triangle lies.
struct Spoke {
  EdgeUse use;
  bool rising = false;
  std::uint32_t sheet = 0;
  double angle = 0;  ///< from 0 to 4, in quarter turns but for a bend between them; -1: the triangle has no side
};

/// Grows from 0 to 4 with the angle of (x, y), by exact operations alone.
double angleOf(double x, double y) {
  const double share = std::abs(x) + std::abs(y);
  if (!(share > 0)) return -1;
  const double turn = y / share;
  return x < 0 ? 2 - turn : turn < 0 ? 4 + turn : turn;
}

class Orienting {
 public:
  explicit Orienting(Patient& patient)
      : patient_(patient), places_(patient.allPlaces()), turned_(places_.size(), false), sheet_(places_.size()) {
    sheets_.neighbours.assign(places_.size(), {noTriangle, noTriangle, noTriangle});
  }

  Sheets run() {
    forEachEdge(places_, patient_.mesh.vertices.size(), [&](std::uint32_t low, std::span<const EdgeUse> uses) {
      if (uses.size() == 1) sheets_.openEdges.note(middle(low, uses[0]), sourceOf(uses[0]));
      if (uses.size() == 2) join(uses[0], uses[1]);
      if (uses.size() > 2) tangles_.push_back({low, {uses.begin(), uses.end()}});
    });
    for (std::uint32_t t = 0; t < places_.size(); ++t) sheet_[t] = noTriangle;
    for (std::uint32_t t = 0; t < places_.size(); ++t)
      if (sheet_[t] == noTriangle) agree(t);
    countTwisted();
    untangle();
    turnAll();
    return std::move(sheets_);
  }

 private:
  Vec3d middle(std::uint32_t low, const EdgeUse& use) const { return (patient_.at(low) + patient_.at(use.high)) * 0.5; }
  std::uint32_t sourceOf(const EdgeUse& use) const { return patient_.source[use.slot / 3]; }

  void join(const EdgeUse& a, const EdgeUse& b) {
    sheets_.neighbours[a.slot / 3][a.slot % 3] = b.slot / 3;
    sheets_.neighbours[b.slot / 3][b.slot % 3] = a.slot / 3;
  }

  /// Whether two neighbours over edge e of t go through it the same way as they are stored.
  bool sameWay(std::uint32_t t, std::uint32_t e, std::uint32_t other) const {
    const std::uint32_t from = places_[t][e], to = places_[t][(e + 1) % 3];
    for (std::size_t i = 0; i < 3; ++i)
      if (places_[other][i] == from && places_[other][(i + 1) % 3] == to) return true;
    return false;
  }

  /// Walks over one sheet from its first triangle; then turns what fewer say.
  void agree(std::uint32_t start) {
    std::vector<std::uint32_t> sheet{start};
    sheet_[start] = start;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < sheet.size(); ++i) {
      const std::uint32_t t = sheet[i];
      for (std::uint32_t e = 0; e < 3; ++e) {
        const std::uint32_t other = sheets_.neighbours[t][e];
        if (other == noTriangle || sheet_[other] != noTriangle) continue;
        sheet_[other] = start;
        turned_[other] = turned_[t] != sameWay(t, e, other);
        turned += turned_[other];
        sheet.push_back(other);
      }
    }
    if (2 * turned <= sheet.size()) return;
    for (const std::uint32_t t : sheet) turned_[t] = !turned_[t];
  }

  void countTwisted() {
    for (std::uint32_t t = 0; t < places_.size(); ++t)
      for (std::uint32_t e = 0; e < 3; ++e) {
        const std::uint32_t other = sheets_.neighbours[t][e];
        if (other == noTriangle || other < t || (turned_[t] != turned_[other]) == sameWay(t, e, other)) continue;
        const Vec3d middle = (patient_.at(places_[t][e]) + patient_.at(places_[t][(e + 1) % 3])) * 0.5;
        sheets_.twistedEdges.note(middle, patient_.source[t]);
      }
  }

  void untangle() {
    Defect apart;
    for (const Tangle& tangle : tangles_) {
      const std::vector<Spoke> spokes = spokesOf(tangle);
      const bool told = areApart(spokes) && (pairSheets(spokes) || pairSolids(spokes));
      (told ? apart : sheets_.tangledEdges).note(middle(tangle.low, tangle.uses[0]), sourceOf(tangle.uses[0]));
    }
    patient_.note("edges of several sheets taken apart", apart);
  }

  /// In order around the edge, counter-clockwise seen against its direction from low to high.
  std::vector<Spoke> spokesOf(const Tangle& tangle) const {
    std::vector<Spoke> spokes;
    const Vec3d origin = patient_.at(tangle.low), axis = normalized(patient_.at(tangle.uses[0].high) - origin);
    const auto sideOf = [&](const EdgeUse& use) {
      const Vec3d arm = patient_.at(places_[use.slot / 3][(use.slot + 2) % 3]) - origin;
      return arm - axis * dot(arm, axis);
    };
    const Vec3d x = normalized(sideOf(tangle.uses[0])), y = cross(axis, x);
    for (const EdgeUse& use : tangle.uses) {
      const std::uint32_t t = use.slot / 3;
      const Vec3d side = sideOf(use);
      spokes.push_back({use, use.rising != turned_[t], sheet_[t], angleOf(dot(side, x), dot(side, y))});
    }
    std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
      return a.angle != b.angle ? a.angle < b.angle : a.use.slot < b.use.slot;
    });
    return spokes;
  }

  static bool areApart(const std::vector<Spoke>& spokes) {
    bool apart = spokes.front().angle >= 0 && spokes.front().angle + 4 - spokes.back().angle > clearlyApart;
    for (std::size_t i = 1; i < spokes.size(); ++i)
      apart = apart && spokes[i].angle - spokes[i - 1].angle > clearlyApart;
    return apart;
  }

  /// Joins each spoke i of `first`, `first` + 2, ... with the next around the edge.
  void joinFrom(const std::vector<Spoke>& spokes, std::size_t first) {
    for (std::size_t i = first; i < spokes.size() + first; i += 2)
      join(spokes[i % spokes.size()].use, spokes[(i + 1) % spokes.size()].use);
  }

  /// Sheets that each come to the edge and leave it side by side, like boxes that touch along an edge.
  bool pairSheets(const std::vector<Spoke>& spokes) {
    for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
      bool fits = spokes.size() % 2 == 0;
      std::vector<std::uint32_t> seen;
      for (std::size_t i = first; fits && i < spokes.size() + first; i += 2) {
        const Spoke &a = spokes[i % spokes.size()], &b = spokes[(i + 1) % spokes.size()];
        fits = a.sheet == b.sheet && a.rising != b.rising && std::find(seen.begin(), seen.end(), a.sheet) == seen.end();
        seen.push_back(a.sheet);
      }
      if (fits) return joinFrom(spokes, first), true;
    }
    return false;
  }

  /// The solid lies ahead of a triangle that falls, seen the way of the angle, and behind one that rises: what bounds
  /// one wedge of solid belongs together.
  bool pairSolids(const std::vector<Spoke>& spokes) {
    for (std::size_t i = 0; i < spokes.size(); ++i)
      if (spokes.size() % 2 != 0 || spokes[i].rising == spokes[(i + 1) % spokes.size()].rising) return false;
    joinFrom(spokes, spokes[0].rising ? 1 : 0);
    return true;
  }

  void turnAll() {
    Defect turned;
    for (std::uint32_t t = 0; t < turned_.size(); ++t) {
      if (!turned_[t]) continue;
      patient_.count(turned, t);
      sheets_.turnOver(patient_, t);
    }
    patient_.note("triangles turned to agree with their neighbours", turned);
  }

  Patient& patient_;
  std::vector<Triangle> places_;
  std::vector<bool> turned_;
  std::vector<std::uint32_t> sheet_;  ///< per triangle, the first of those that edges of two join to it
  std::vector<Tangle> tangles_;
  Sheets sheets_;
};

}  // namespace

void Sheets::turnOver(Patient& patient, std::uint32_t triangle) {
  std::swap(patient.mesh.triangles[triangle][1], patient.mesh.triangles[triangle][2]);
  std::swap(neighbours[triangle][0], neighbours[triangle][2]);
}

Sheets orient(Patient& patient) { return Orienting(patient).run(); }

}  // namespace brisance
