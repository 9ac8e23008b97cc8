// Small scenes in a fresh directory of their own.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/check.h"
#include "scene/scene_file.h"

namespace brisance {

/// A directory that is empty at first and gone at last.
class FreshDirectory {
 public:
  FreshDirectory() {
    std::string pattern = (std::filesystem::temp_directory_path() / "brisance_scene_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~FreshDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FreshDirectory(const FreshDirectory&) = delete;
  FreshDirectory& operator=(const FreshDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
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
