// Atoms fused into pieces: their meshes, with everything that the body's own triangles carried.
#pragma once

#include "fracture/cell_atoms.h"

namespace brisance {

/// One mesh per piece in the body's coordinates; `pieceOf` names each atom's. Outside triangles first, with the mesh's
/// materials, normals and uvs; then inside faces, flat, of a material of their own named "inside", with uvs in metres
/// of their plane. Vertices are doubled only where normals or uvs differ, so the welded mesh is closed.
std::vector<TriangleMesh> pieceMeshes(const TriangleMesh& mesh, const CellComplex& complex, const CellAtoms& atoms,
                                      const Partition& pieces);

/// Whether each piece's edges join two triangles, told apart by places. What cutting leaves alone is not looked at.
bool piecesAreManifold(const CellComplex& complex, const CellAtoms& atoms, const Partition& pieces);

/// Contacts between different pieces, summed.
std::vector<Contact> pieceContacts(const CellAtoms& atoms, const Partition& pieces);

}  // namespace brisance
