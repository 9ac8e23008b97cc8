// How a body may be broken: every partitioner by its name, with its own knobs and nothing else.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "base/math.h"

namespace brisance {

struct BreadthFirst {};  ///< the connected, any-m variant of thesis Algorithm 5

enum class ThesisSplit { list, level };
/// Thesis Algorithm 5 as printed, with its fix for lost triangles. Pieces must be a power of two; they may be several
/// islands.
struct BreadthFirstThesis {
  ThesisSplit split = ThesisSplit::list;  ///< where the breadth-first order is cut: half of the list, or half of the
                                          ///< levels
};

enum class CurvatureWeights { clipped, raw };
enum class InsideParts { all, smallest, largest };
/// Thesis Algorithm 6: edges are as strong as the surface is flat. The weakest cut first, by recursion.
struct Curvature {
  CurvatureWeights weights = CurvatureWeights::clipped;
  int parts = 0;                          ///< this many parts by curvature, the rest of the pieces breadth-first inside
                                          ///< them; 0: all pieces by curvature
  InsideParts inside = InsideParts::all;  ///< which parts are broken further
};

enum class EdgeWeights { unit, length };
/// As Curvature, with weights that know nothing of curvature.
struct Spectral {
  EdgeWeights weights = EdgeWeights::unit;
};

/// Cells of seeded points.
struct Voronoi {
  std::optional<Vec3d> impact;  ///< [m] cells crowd towards it; absent: uniform
  double crowding = 2;          ///< 0: uniform; larger: smaller cells near the impact
};

using FractureMethod = std::variant<BreadthFirst, BreadthFirstThesis, Curvature, Spectral, Voronoi>;

/// Pieces of a closed mesh are solids instead of shells.
struct SolidSettings {
  bool enabled = false;
  int cellsPerPiece = 0;  ///< how rough inside faces are: small cells that a piece is fused from. 0: by the method,
                          ///< 1 for voronoi, 24 for the others
  bool flat = false;      ///< inside faces flat, whatever the method
};

struct FractureSettings {
  FractureMethod method;
  int pieces = 1;           ///< 1: left whole
  bool refine = false;      ///< cuts shortened and sizes evened out afterwards
  double minimumShare = 0;  ///< least size of a piece, relative to the mean; smaller ones join a neighbour and the
                            ///< largest is split instead
  SolidSettings solid;
  std::uint64_t seed = 1;
};

}  // namespace brisance
