// Small scenes in a fresh directory of their own.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/check.h"
#include "scene/scene_file.h"
#include "scratch_directory.h"

namespace brisance {

/// A fresh directory to which a test writes its files.
class FreshDirectory : public ScratchDirectory {
 public:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path() / name).parent_path());
    std::ofstream(path() / name, std::ios::binary) << text;
    return path() / name;
  }
};

/// What goes wrong with a text that stands in "s.toml", or "nothing".
struct Trouble {
  std::string line = "nothing";
  ExitCode code = ExitCode::done;
};
inline Trouble troubleOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parseScene(text, "s.toml", overrides);
  } catch (const Error& error) {
    return {error.what(), error.code};
  }
  return {};
}

}  // namespace brisance
