// Files that become durable together: what a disk does for one sync, it does for all of them.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <vector>

#include "base/durable_file.h"

namespace brisance {

class DurableBatch {
 public:
  DurableBatch();
  /// Removes what was added and not finished.
  ~DurableBatch();
  DurableBatch(const DurableBatch&) = delete;
  DurableBatch& operator=(const DurableBatch&) = delete;

  /// Writes `path` through a checked stream, under a temporary name. Throws as writeDurably does.
  FileRecord add(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);
  /// Syncs all files, then gives them their names, then syncs their directories, each once. Only this makes the files
  /// be there. Killed on the way, some may have their names, all whole.
  void finish();

 private:
  struct Written;
  std::vector<Written> files_;
};

}  // namespace brisance
