#include "simulation/run_writer.h"

namespace brisance {

void RunWriter::write(FrameToWrite frame) {
  wait();
  writing_ = std::async(std::launch::async, [this, frame = std::move(frame)] {
    run_.add(frame.files);
    if (!frame.checkpoint.empty()) saveCheckpoint(run_, frame.frame, frame.checkpoint, frame.checkpointsKept);
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

void saveCheckpoint(RunDirectory& run, int frame, const std::string& bytes, std::size_t keep) {
  run.add(frameFile("checkpoints", "checkpoint", frame, "bin"), bytes);
  std::vector<std::string> names = checkpointsOf(run);
  names.resize(names.size() > keep ? names.size() - keep : 0);
  if (!names.empty()) run.remove(names);
}

}  // namespace brisance
