// A body that `brisance fracture` has broken: how it came about, and what is told and written of it.
#pragma once

#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "fracture/fracture.h"
#include "frame/frame.h"
#include "options.h"

namespace brisance {

struct BrokenBody {
  std::string name;
  FractureSettings settings;
  Pose pose;
  std::string material;  ///< of pieces whose mesh names none
  TriangleMesh input;    ///< as read, and mended where that was asked; empty for a pane
  bool inputClosed = false;
  std::vector<std::string> repairs;  ///< what was mended, a line each
  FracturedBody broken;
  double readSeconds = 0, breakSeconds = 0;
};

/// Throws InputError and DamagedFile naming the file.
BrokenBody breakMeshFile(const Options& options);
/// All bodies of a scene file that move, broken as it says.
std::vector<BrokenBody> breakScene(const Options& options);

/// Named pieces in their places. Corners lie on a lattice that 32-bit floats hold exactly, so that corners which
/// neighbours share are the same in a file, too.
std::vector<FrameBody> piecesAtRest(const std::vector<BrokenBody>& bodies);

/// One line for scripts; docs/files.md has the keys.
std::string fractureJson(const std::vector<BrokenBody>& bodies, const Options& options, double writeSeconds);
/// A few lines for people.
std::string fractureText(const std::vector<BrokenBody>& bodies, const std::vector<std::filesystem::path>& outputs,
                         double writeSeconds);

}  // namespace brisance
