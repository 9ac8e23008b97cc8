// Figures of chapters 3 and 4 of the thesis, drawn anew, and of the gas against textbooks.
#pragma once

#include "mesh/flat_drawing.h"

namespace brisance::assets {

FlatDrawing trisectionFigure();       ///< 3.4
FlatDrawing voronoiFigure();          ///< 3.5: the same points
FlatDrawing delaunayFigure();         ///< 3.6: the same points
FlatDrawing firstLevelsFigure();      ///< 4.1: distances of a breadth-first search, and its cut
FlatDrawing secondLevelsFigure();     ///< 4.2: the farther part again; its own farther part falls into islands
FlatDrawing vibratingStringFigure();  ///< 4.3
FlatDrawing struckPaneFigure();       ///< a pane of glass after a blow
FlatDrawing outlinesFigure();         ///< a disc and a concave polygon in pieces

struct CavityFigures {
  FlatDrawing u, v;
};
CavityFigures cavityFigures();    ///< profiles of a cavity with a moving lid against Ghia et al. 1982
FlatDrawing vortexDecayFigure();  ///< a Taylor-Green vortex by every scheme
FlatDrawing gasOrderFigure();     ///< errors of transport and pressure over the cells

}  // namespace brisance::assets
