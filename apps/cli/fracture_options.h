// What can be typed behind `brisance fracture`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fracture/fracture_settings.h"

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's
class App;
}

namespace brisance {

struct FractureOptions {
  FractureSettings settings;  ///< of a mesh; a scene has its own
  bool givenForMesh = false;  ///< one of the options that only a mesh takes was typed
  bool repair = false;        ///< mend the mesh first, as is always done for solids
  std::vector<std::filesystem::path> outputs;
  bool picture = true;           ///< beside every glTF file
  std::filesystem::path labels;  ///< one piece number per input triangle; empty: not asked
  double explode = 0.3;          ///< how far pieces are pulled apart in the picture
};

/// As typed, before the method's own options have found their method.
struct RawFractureOptions {
  FractureOptions options;
  std::string method = "breadth_first";
  std::optional<std::string> weights, split, inside, impact;
  std::optional<int> parts;
  std::optional<double> crowding;
};

/// Adds the options to the command line's word `fracture`.
void addFractureOptions(CLI::App& command, RawFractureOptions& raw);
/// Throws InputError with one line naming the option that does not fit.
FractureOptions finished(const RawFractureOptions& raw, const CLI::App& command);

}  // namespace brisance
