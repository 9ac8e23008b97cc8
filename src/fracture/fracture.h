// A body is broken before time starts.
#pragma once

#include "fracture/fracture_settings.h"
#include "mesh/mass_properties.h"
#include "mesh/triangulation.h"

namespace brisance {

/// Where two pieces touch.
struct Bond {
  int a = 0, b = 0;
  double area = 0;  ///< [m2]
  Vec3d normal;     ///< from a to b
  Vec3d place{};    ///< [m] centroid of the shared faces, or of the shared border of shells, in the body's coordinates
};

struct Piece {
  TriangleMesh mesh;  ///< about its own centroid; closed where the body was made solid
  MassProperties properties;
  Vec3d place;  ///< of the centroid in the body's coordinates [m]
};

struct FracturedBody {
  std::vector<Piece> pieces;
  std::vector<Bond> bonds;
  std::vector<int> pieceOfTriangle;               ///< of a mesh cut along its own triangles, in their order; else empty
  std::vector<double> eigenvalues;                ///< of the first spectral cut: 0, and the smallest others; else empty
  bool solid = false;                             ///< pieces fill the body; else they are shells of its surface
  double graphSeconds = 0, partitionSeconds = 0;  ///< spent on the graph, and on choosing pieces
};

/// A flat pane of glass (thesis 3.3): points, triangles, pieces, each extruded. In the x-y plane. A texture is
/// stretched over the box around the outline, and shows on both faces.
struct PaneSettings {
  Outline outline = RectangleOutline{};
  double thickness = 0.005;  ///< [m]
  PointPattern pattern = UniformPoints{};
  int points = 200;  ///< inside the outline
  Triangulation triangulation = Trisection{};
};
/// Throws InputError for an outline or a pattern with a fault.
FracturedBody fracturePane(const PaneSettings& pane, const FractureSettings& fracture, std::uint64_t seed);

/// Where a mesh that is cut along its own triangles comes apart.
struct CutLine {
  int edges = 0;
  double length = 0;  ///< [m]
};
CutLine cutLine(const TriangleMesh& mesh, const std::vector<int>& pieceOfTriangle);

/// A mesh cut along its own triangles: pieces of a closed mesh are open shells (thesis 4.2), whole if pieces = 1. With
/// settings.solid the pieces are solids (solid_fracture.h); the mesh must be closed then. Throws InputError.
FracturedBody fractureMesh(const TriangleMesh& mesh, const FractureSettings& fracture, double shellThickness);

}  // namespace brisance
