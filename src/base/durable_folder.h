// A folder of files that is whole or not there: filled under a temporary name, then renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "base/durable_file.h"

namespace brisance {

class DurableFolder {
 public:
  /// Nothing is seen under `path` before finish(). Throws Error(noRoom) where nothing may be written.
  explicit DurableFolder(const std::filesystem::path& path);
  /// Takes away what was not finished.
  ~DurableFolder();
  DurableFolder(const DurableFolder&) = delete;
  DurableFolder& operator=(const DurableFolder&) = delete;

  /// Writes one file durably; trouble is told with its final name.
  FileRecord add(const std::string& name, const std::function<void(std::ostream&)>& write);
  FileRecord add(const std::string& name, std::string_view bytes);
  /// Takes the final name. A folder that is there already gives way, and is removed.
  void finish();

 private:
  std::filesystem::path final_, temporary_;
  bool finished_ = false;
};

}  // namespace brisance
