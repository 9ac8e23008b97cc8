#include "simulation/run_writer.h"

#include "base/check.h"

namespace brisance {

void RunWriter::write(FrameToWrite frame) {
  CHECK(!writing_.valid(), "a frame is still being written");
  writing_ = std::async(std::launch::async, [this, frame = std::move(frame)]() mutable {
    run_.add(frame.files);
    if (!frame.checkpoint.name.empty()) saveCheckpoint(run_, std::move(frame.checkpoint), frame.checkpointsKept);
  });
}

void RunWriter::wait() {
  if (writing_.valid()) writing_.get();
}

std::vector<std::string> checkpointsOf(const RunDirectory& run) {
  std::vector<std::string> names;
  for (const auto& [name, entry] : run.manifest())
    if (name.starts_with("checkpoints/")) names.push_back(name);
  return names;
}

StagedFile stageCheckpoint(const RunDirectory& run, int frame, const std::function<void(std::ostream&)>& write) {
  return run.stage(frameFile("checkpoints", "checkpoint", frame, "bin"), write);
}

void saveCheckpoint(RunDirectory& run, StagedFile checkpoint, std::size_t keep) {
  run.add(std::move(checkpoint));
  keepNewestCheckpoints(run, keep);
}

void keepNewestCheckpoints(RunDirectory& run, std::size_t keep) {
  std::vector<std::string> names = checkpointsOf(run);
  names.resize(names.size() > keep ? names.size() - keep : 0);
  if (!names.empty()) run.remove(names);
}

}  // namespace brisance
