#include "fracture/atom_surfaces.h"

#include "base/check.h"
#include "fracture/solid_angle.h"

namespace brisance {
namespace {

std::size_t slotCount(const CellComplex& complex) {
  return complex.surface.places.size() + 3 * complex.cut.points.size() + 4 * complex.meetings.size();
}

}  // namespace

AtomSurfaces::AtomSurfaces(const CellComplex& complex)
    : complex_(complex), sets_(slotCount(complex)), sheetOfRoot_(slotCount(complex), noVertex) {
  Box3 box;
  for (const Vec3d& p : complex.surface.places) box.include(p);
  middle_ = (box.lower + box.upper) * 0.5;
}

std::uint32_t AtomSurfaces::slot(std::uint32_t vertex, std::uint32_t cell) const {
  const std::uint32_t firstPoint = complex_.firstPoint(), firstMeeting = complex_.firstMeeting();
  if (vertex < firstPoint) return vertex;
  if (vertex >= firstMeeting) {
    const std::uint32_t meeting = vertex - firstMeeting;
    const auto& seeds = complex_.diagram.tetrahedra()[complex_.meetings[meeting]].seeds;
    const auto place = std::find(seeds.begin(), seeds.end(), cell) - seeds.begin();
    return firstPoint + 3 * (firstMeeting - firstPoint) + 4 * meeting + static_cast<std::uint32_t>(place);
  }
  const std::uint32_t point = vertex - firstPoint;
  const CutPoint& name = complex_.cut.points[point];
  const auto cells = name.of.begin() + (name.kind == CutPoint::onEdge ? 2 : 1);
  return firstPoint + 3 * point + static_cast<std::uint32_t>(std::find(cells, name.of.end(), cell) - cells);
}

/// Calls visit(first vertex, second, third, cell, sense) for all triangles of all cells' borders, polygons fanned.
template <class Visit>
void AtomSurfaces::forEachTriangle(const Visit& visit) const {
  const CutSurface& cut = complex_.cut;
  for (std::uint32_t t = 0; t < cut.cellOfTriangle.size(); ++t)
    if (cut.cellOfTriangle[t] != noCell) visit(complex_.surface.triangles[t], cut.cellOfTriangle[t], 1.0);
  for (const CutPolygon& polygon : cut.polygons)
    for (std::uint32_t n = 1; n + 1 < polygon.count; ++n) {
      const auto* corners = &cut.corners[polygon.first];
      visit(Triangle{corners[0], corners[n], corners[n + 1]}, polygon.cell, 1.0);
    }
  for (const Cap& cap : complex_.caps)
    for (std::uint32_t t = cap.first; t < cap.first + cap.count; ++t) {
      visit(complex_.capTriangles[t], cap.lowCell, 1.0);
      visit(complex_.capTriangles[t], cap.highCell, -1.0);
    }
}

void AtomSurfaces::joinAll() {
  forEachTriangle([&](const Triangle& t, std::uint32_t cell, double) {
    const std::uint32_t a = slot(t[0], cell);
    sets_.join(a, slot(t[1], cell));
    sets_.join(a, slot(t[2], cell));
  });
}

std::uint32_t AtomSurfaces::sheetOf(std::uint32_t vertex, std::uint32_t cell) {
  return sheetOfRoot_[sets_.root(slot(vertex, cell))];
}

void AtomSurfaces::measure(std::uint32_t sheet, std::uint32_t cell, const Triangle& triangle, double sense) {
  const Vec3d a = complex_.places[triangle[0]] - middle_, b = complex_.places[triangle[1]] - middle_,
              c = complex_.places[triangle[2]] - middle_;
  const double volume = sense * dot(a, cross(b, c)) / 6;
  sheets_[sheet].cell = cell;
  sheets_[sheet].volume += volume;
  sheets_[sheet].moment += (a + b + c) * (volume / 4);
}

void AtomSurfaces::measureAll() {
  forEachTriangle([&](const Triangle& t, std::uint32_t cell, double sense) {
    std::uint32_t& sheet = sheetOfRoot_[sets_.root(slot(t[0], cell))];
    if (sheet == noVertex) {
      sheet = static_cast<std::uint32_t>(sheets_.size());
      sheets_.push_back({});
      sheets_.back().somewhere = complex_.places[t[0]];
    }
    measure(sheet, cell, t, sense);
  });
}

/// Atoms in order of their cells, the largest of a cell first.
void AtomSurfaces::nameAtoms(CellAtoms& atoms) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t s = 0; s < sheets_.size(); ++s)
    if (sheets_[s].volume > 0) order.push_back(s);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Sheet &x = sheets_[a], &y = sheets_[b];
    return x.cell != y.cell ? x.cell < y.cell : x.volume > y.volume;
  });
  for (const std::uint32_t s : order) {
    sheets_[s].atom = static_cast<int>(atoms.atoms.size());
    atoms.atoms.push_back({sheets_[s].cell, sheets_[s].volume, sheets_[s].moment});
  }
}

/// How far the atoms of its cell surround each cavity: 4 pi inside, 0 outside.
std::vector<std::vector<double>> AtomSurfaces::anglesAbout(const std::vector<std::vector<std::uint32_t>>& cavitiesOf,
                                                           const std::vector<std::vector<int>>& atomsOf) {
  std::vector<std::vector<double>> angle(sheets_.size());
  for (std::uint32_t cell = 0; cell < cavitiesOf.size(); ++cell)
    for (const std::uint32_t s : cavitiesOf[cell]) angle[s].assign(atomsOf[cell].size(), 0);
  forEachTriangle([&](const Triangle& t, std::uint32_t cell, double sense) {
    if (cavitiesOf[cell].empty()) return;
    const int atom = sheets_[sheetOf(t[0], cell)].atom;
    if (atom < 0) return;
    for (const std::uint32_t s : cavitiesOf[cell]) {
      const Vec3d& eye = sheets_[s].somewhere;
      angle[s][atom - atomsOf[cell].front()] +=
          sense * solidAngle(complex_.places[t[0]] - eye, complex_.places[t[1]] - eye, complex_.places[t[2]] - eye);
    }
  });
  return angle;
}

/// A cavity belongs to the smallest atom of its cell that surrounds it. What none surrounds is a sliver whose volume
/// rounding has made negative, and an atom of its own.
void AtomSurfaces::placeCavities(CellAtoms& atoms) {
  std::vector<std::vector<std::uint32_t>> cavitiesOf(complex_.diagram.cellCount());
  std::vector<std::vector<int>> atomsOf(complex_.diagram.cellCount());
  for (std::uint32_t s = 0; s < sheets_.size(); ++s)
    if (sheets_[s].atom < 0) cavitiesOf[sheets_[s].cell].push_back(s);
  for (std::size_t a = 0; a < atoms.atoms.size(); ++a) atomsOf[atoms.atoms[a].cell].push_back(static_cast<int>(a));
  const auto angle = anglesAbout(cavitiesOf, atomsOf);
  for (std::uint32_t s = 0; s < sheets_.size(); ++s) {
    Sheet& sheet = sheets_[s];
    if (sheet.atom >= 0) continue;
    for (std::size_t n = 0; n < angle[s].size(); ++n)
      if (angle[s][n] > 2 * pi) sheet.atom = atomsOf[sheet.cell][n];  // the largest come first
    if (sheet.atom >= 0) {
      atoms.atoms[sheet.atom].volume += sheet.volume;
      atoms.atoms[sheet.atom].centroid += sheet.moment;
    } else {
      sheet.atom = static_cast<int>(atoms.atoms.size());
      atoms.atoms.push_back({sheet.cell, 0, {}});
    }
  }
}

CellAtoms AtomSurfaces::atoms() {
  CellAtoms atoms;
  joinAll();
  measureAll();
  nameAtoms(atoms);
  placeCavities(atoms);
  for (Atom& atom : atoms.atoms) atom.centroid = atom.volume > 0 ? middle_ + atom.centroid / atom.volume : middle_;
  const CutSurface& cut = complex_.cut;
  const auto atomAt = [&](std::uint32_t vertex, std::uint32_t cell) { return sheets_[sheetOf(vertex, cell)].atom; };
  for (std::uint32_t t = 0; t < cut.cellOfTriangle.size(); ++t) {
    const std::uint32_t cell = cut.cellOfTriangle[t];
    atoms.ofTriangle.push_back(cell == noCell ? -1 : atomAt(complex_.surface.triangles[t][0], cell));
  }
  for (const CutPolygon& polygon : cut.polygons)
    atoms.ofPolygon.push_back(atomAt(cut.corners[polygon.first], polygon.cell));
  for (const Cap& cap : complex_.caps)
    for (std::uint32_t t = cap.first; t < cap.first + cap.count; ++t) {
      const std::uint32_t vertex = complex_.capTriangles[t][0];
      atoms.ofCapTriangle.push_back({atomAt(vertex, cap.lowCell), atomAt(vertex, cap.highCell)});
    }
  return atoms;
}

}  // namespace brisance
