// Bodies that stand or move in the gas become shares of faces (Batty, Bertails & Bridson 2007; Ng, Min & Gibou 2009).
#pragma once

#include <map>
#include <optional>
#include <span>

#include "fluid/fluid_state.h"
#include "fluid/solid_lattice.h"

namespace brisance {

/// A face lets through the share of it that lies in no body, exactly, and nothing where a surface stands between the
/// gas of its two cells, however thin (Guendelman, Selle, Losasso & Fedkiw 2005; gas_points.h). Walled faces of the box
/// are closed. What it makes depends on the bodies' places alone, not on where they were before.
class SolidStamper {
 public:
  SolidStamper(const FluidSettings& settings, std::span<const MovingSolid> fixed);

  /// The bodies that do not move, alone.
  const SolidStamp& fixed() const { return fixedStamp_; }
  /// These bodies too. Only rows near where bodies are or were are worked out again. `stamp` is one that this made
  /// last, or a copy of `fixed`.
  void stampMoving(std::span<const MovingSolid> moving, SolidStamp& stamp);

 private:
  bool isSolid(const MovingSolid& body);
  std::vector<BodyCut> cut(std::span<const MovingSolid> bodies);
  void restore(SolidStamp& stamp);

  FluidSettings settings_;
  LatticeBox box_;
  std::map<std::shared_ptr<const TriangleMesh>, bool> watertight_;
  TriangleBins fixedBins_;
  SolidLattice fixedLattice_;
  SolidStamp fixedStamp_;
  std::optional<SolidLattice> lattice_;  // with the moving bodies, once there are any
  RowSet changed_;                       // rows in which that differs
};

/// Of bodies that do not move.
SolidStamp stampSolids(const FluidSettings& settings, std::span<const MovingSolid> solids);

}  // namespace brisance
