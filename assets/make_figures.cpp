// Draws the figures of docs/: make_figures DIRECTORY
#include <cstdio>

#include "assets/figures.h"
#include "base/check.h"

namespace {

using namespace brisance::assets;

void drawAll(const std::filesystem::path& directory) {
  using brisance::writeDrawing;
  writeDrawing(directory / "figure_3_4.svg", trisectionFigure());
  writeDrawing(directory / "figure_3_5.svg", voronoiFigure());
  writeDrawing(directory / "figure_3_6.svg", delaunayFigure());
  writeDrawing(directory / "figure_4_1.svg", firstLevelsFigure());
  writeDrawing(directory / "figure_4_2.svg", secondLevelsFigure());
  writeDrawing(directory / "figure_4_3.svg", vibratingStringFigure());
  writeDrawing(directory / "struck_pane.svg", struckPaneFigure());
  writeDrawing(directory / "outlines.svg", outlinesFigure());
  writeDrawing(directory / "vortex_decay.svg", vortexDecayFigure());
  writeDrawing(directory / "gas_orders.svg", gasOrderFigure());
  const CavityFigures cavity = cavityFigures();
  writeDrawing(directory / "cavity_u.svg", cavity.u);
  writeDrawing(directory / "cavity_v.svg", cavity.v);
}

}  // namespace

int main(int argumentCount, char** arguments) {
  if (argumentCount != 2) {
    std::fputs("usage: make_figures DIRECTORY\n", stderr);
    return static_cast<int>(brisance::ExitCode::badScene);
  }
  try {
    drawAll(arguments[1]);
  } catch (const brisance::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code);
  }
  return 0;
}
