#include "fracture/cell_atoms.h"

#include <map>

#include "base/check.h"
#include "fracture/atom_surfaces.h"

namespace brisance {
namespace {

double triangleArea(const Vec3d& a, const Vec3d& b, const Vec3d& c) { return 0.5 * length(cross(b - a, c - a)); }

/// Contacts of all cap triangles between different atoms.
std::vector<Contact> contactsOf(const CellComplex& complex, const CellAtoms& atoms) {
  std::map<std::pair<int, int>, Contact> byPair;
  for (std::size_t t = 0; t < complex.capTriangles.size(); ++t) {
    auto [a, b] = atoms.ofCapTriangle[t];
    const double sense = a < b ? 1 : -1;
    if (a > b) std::swap(a, b);
    const auto& [p, q, r] = complex.capTriangles[t];
    const Vec3d &x = complex.places[p], &y = complex.places[q], &z = complex.places[r];
    const double area = triangleArea(x, y, z);
    Contact& contact = byPair[{a, b}];
    contact.a = a;
    contact.b = b;
    contact.area += area;
    contact.normal += cross(y - x, z - x) * (0.5 * sense);
    contact.place += (x + y + z) * (area / 3);
  }
  std::vector<Contact> contacts;
  for (auto& [pair, contact] : byPair) {
    if (contact.area > 0) contact.place = contact.place / contact.area;
    contacts.push_back(contact);
  }
  return contacts;
}

/// Per atom the mean strength of its outside vertices; 0 where it has none.
std::vector<double> outsideStrength(const CellComplex& complex, const CellAtoms& atoms,
                                    const std::vector<double>& vertexStrength) {
  std::vector<double> sum(atoms.atoms.size(), 0), weight(atoms.atoms.size(), 0);
  const auto add = [&](int atom, std::uint32_t triangle) {
    for (const std::uint32_t corner : complex.surface.corners[triangle]) sum[atom] += vertexStrength[corner];
    weight[atom] += 3;
  };
  for (std::uint32_t t = 0; t < atoms.ofTriangle.size(); ++t)
    if (atoms.ofTriangle[t] >= 0) add(atoms.ofTriangle[t], t);
  for (std::size_t p = 0; p < atoms.ofPolygon.size(); ++p) add(atoms.ofPolygon[p], complex.cut.polygons[p].triangle);
  for (std::size_t a = 0; a < sum.size(); ++a) sum[a] = weight[a] > 0 ? sum[a] / weight[a] : 0;
  return sum;
}

/// Relative to the mean of all that touch the outside; atoms without outside have that mean.
std::vector<double> relativeStrength(const CellComplex& complex, const CellAtoms& atoms,
                                     const std::vector<double>& vertexStrength) {
  if (vertexStrength.empty()) return std::vector<double>(atoms.atoms.size(), 1);
  std::vector<double> strength = outsideStrength(complex, atoms, vertexStrength);
  double sum = 0;
  int count = 0;
  for (const double s : strength) {
    sum += s;
    count += s > 0;
  }
  const double mean = sum / std::max(count, 1);
  for (double& s : strength) s = s > 0 && mean > 0 ? s / mean : 1;
  return strength;
}

}  // namespace

CellAtoms cellAtoms(const CellComplex& complex) {
  CellAtoms atoms = AtomSurfaces(complex).atoms();
  atoms.contacts = contactsOf(complex, atoms);
  return atoms;
}

FractureGraph atomGraph(const CellComplex& complex, const CellAtoms& atoms, const std::vector<double>& vertexStrength) {
  const std::vector<double> strength = relativeStrength(complex, atoms, vertexStrength);
  FractureGraph graph;
  graph.first.assign(atoms.atoms.size() + 1, 0);
  for (const Contact& c : atoms.contacts) {
    ++graph.first[c.a + 1];
    ++graph.first[c.b + 1];
  }
  for (std::size_t a = 0; a < atoms.atoms.size(); ++a) graph.first[a + 1] += graph.first[a];
  std::vector<std::uint32_t> next(graph.first.begin(), graph.first.end() - 1);
  graph.targets.resize(graph.first.back());
  graph.weights.resize(graph.first.back());
  double largest = 0;
  for (const Contact& c : atoms.contacts) largest = std::max(largest, c.area);
  constexpr double leastShare = 1e-9;  // of the largest: sizes and weights stay above zero
  for (const Contact& c : atoms.contacts) {
    const double weight = std::max(c.area, leastShare * largest) * 0.5 * (strength[c.a] + strength[c.b]);
    for (const auto& [from, to] : {std::pair(c.a, c.b), std::pair(c.b, c.a)}) {
      graph.targets[next[from]] = static_cast<std::uint32_t>(to);
      graph.weights[next[from]++] = weight;
    }
  }
  double most = 0;
  for (const Atom& atom : atoms.atoms) most = std::max(most, atom.volume);
  for (const Atom& atom : atoms.atoms) {
    graph.sizes.push_back(std::max(atom.volume, leastShare * most));
    graph.places.push_back(atom.centroid);
  }
  return graph;
}

}  // namespace brisance
