// Writes what a simulation made while the simulation goes on.
#pragma once

#include <functional>
#include <future>
#include <ostream>
#include <string>
#include <vector>

#include "frame/run_directory.h"

namespace brisance {

/// A frame's files and, where there is one, the checkpoint at its end.
struct FrameToWrite {
  std::vector<NewFile> files;
  StagedFile checkpoint;            ///< without a name: none
  std::size_t checkpointsKept = 2;  ///< of the newest, with this one
};

/// One frame at a time is on its way to the disk: first its files, then the manifest, then its checkpoint, and older
/// checkpoints go. While one is, nobody else may use the run directory.
class RunWriter {
 public:
  explicit RunWriter(RunDirectory& run) : run_(run) {}
  /// The one before must have been waited for.
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
void saveCheckpoint(RunDirectory& run, StagedFile checkpoint, std::size_t keep);
/// Forgets all but the last `keep`.
void keepNewestCheckpoints(RunDirectory& run, std::size_t keep);
/// Written, not yet there.
StagedFile stageCheckpoint(const RunDirectory& run, int frame, const std::function<void(std::ostream&)>& write);

}  // namespace brisance
