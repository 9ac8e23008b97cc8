// A closed mesh broken into solid pieces.
#pragma once

#include "fracture/fracture.h"

namespace brisance {

/// Closed, oriented pieces, each in one part, whose volumes add up to the mesh's. Voronoi: the cells of seeded points;
/// every other method divides the graph of many small cells (solid.cellsPerPiece for each piece), whose faces are as
/// strong as they are large (`curvature`: times the strength of the surface near them), and fuses each part;
/// solid.flat replaces the rough faces by planes through their middles. Exactly settings.pieces, unless the body has
/// more parts than that (1: the body as it is). Bodies that overlap one another are cut one by one.
///
/// piece.place + vertex is exact: the same for both pieces that share an inside face, whose triangles are the same with
/// their sense reversed, and different for vertices that are not one. Inside faces have the material "inside", outside
/// ones all that the mesh carries. Throws InputError if the mesh is not closed and oriented, encloses nothing, or one
/// body crosses itself so that a piece would stay open.
FracturedBody fractureSolid(const TriangleMesh& mesh, const FractureSettings& settings);

}  // namespace brisance
