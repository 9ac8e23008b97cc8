// Writes what a simulation made while the simulation goes on.
#pragma once

#include <future>
#include <string>
#include <vector>

#include "frame/run_directory.h"

namespace brisance {

/// A frame's files and, where there is one, the checkpoint at its end.
struct FrameToWrite {
  int frame = 1;
  std::vector<NewFile> files;
  std::string checkpoint;           ///< empty: none
  std::size_t checkpointsKept = 2;  ///< of the newest, with this one
};

/// One frame at a time is on its way to the disk: first its files, then the manifest, then its checkpoint, and older
/// checkpoints go. While one is, nobody else may use the run directory.
class RunWriter {
 public:
  explicit RunWriter(RunDirectory& run) : run_(run) {}
  /// Waits for the one before.
  void write(FrameToWrite frame);
  /// Until all is on the disk. Throws what went wrong there.
  void wait();

 private:
  RunDirectory& run_;
  std::future<void> writing_;
};

/// Names of the checkpoints that the manifest knows, in their order.
std::vector<std::string> checkpointsOf(const RunDirectory& run);
/// Adds a checkpoint, then forgets the older ones but the last `keep`.
void saveCheckpoint(RunDirectory& run, int frame, const std::string& bytes, std::size_t keep);

}  // namespace brisance
