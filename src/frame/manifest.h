// The manifest's text, and which names a run may hold.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "frame/run_directory.h"

namespace brisance {

constexpr char manifestName[] = "manifest.json";

/// The four files of a frame, by what they hold; and the shapes of bodies that took another one in it.
struct FrameFileNames {
  explicit FrameFileNames(int index);
  std::string gas, bodies, particles, report, shapes;
  std::vector<std::string> all() const { return {gas, bodies, particles, report}; }
};

std::string manifestToJson(const std::map<std::string, ManifestEntry>& manifest);

/// Last frame N such that frames 1..N are whole in the manifest.
int lastWholeFrame(const std::map<std::string, ManifestEntry>& manifest);

/// True for a relative name that stays inside the run and is neither hidden nor the manifest itself.
bool isNameInRun(const std::string& name);
/// True for the names that a run gives to its files.
bool isNameOfRunFile(const std::string& name);
/// Number of the frame that a file of a run belongs to; 0: to none.
int frameNumberIn(const std::string& name);
/// Folders of a run directory.
const std::vector<std::string>& runFolders();

}  // namespace brisance
