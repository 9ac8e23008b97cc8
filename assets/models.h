// The models of the project's scenes: a cow, a teddy bear, a statue and a pumpkin, each one closed surface.
#pragma once

#include "assets/even_remesh.h"

namespace brisance::samples {

/// A solid, and what its mesh needs to know of it.
struct Model {
  Implicit solid;
  Box3 box;               ///< around it, not touching
  Implicit details;       ///< where its edges shall be shorter
  double fineness;        ///< of the edges there, relative to those elsewhere
  double finest;          ///< [m] a lattice of this step shows every detail
  std::size_t triangles;  ///< as many as the thesis' model of that name has (its Table 5.2)
};

Model cowModel();      ///< stands on y = 0, about 2.5 m long, looks along +x
Model teddyModel();    ///< sits on y = 0, about 1.6 m high, looks along +z
Model statueModel();   ///< a woman in a long robe on a round plinth, about 2 m high, looks along +z
Model pumpkinModel();  ///< lies on y = 0, about 1.2 m wide, with a stem

/// Edges grow from their length on the details to that elsewhere within 0.15 m.
EdgeSize edgeSizeOf(const Model& model);

/// Even triangles; coordinates are rounded to 1e-5 m, so that a file holds them exactly.
TriangleMesh meshOf(const Model& model, long triangles);

TriangleMesh cow(long triangles);
TriangleMesh teddy(long triangles);
TriangleMesh statue(long triangles);
TriangleMesh pumpkin(long triangles);

}  // namespace brisance::samples
