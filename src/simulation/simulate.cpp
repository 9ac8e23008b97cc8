#include "simulation/simulate.h"

#include "base/memory.h"
#include "base/stopwatch.h"
#include "frame/gltf_export.h"
#include "simulation/world_state.h"

namespace brisance {

namespace {
std::string checkpointName(int frame) { return frameFile("checkpoints", "checkpoint", frame, "bin"); }

int frameOfCheckpoint(const std::string& name) {
  const std::size_t dot = name.find('.');
  return dot == std::string::npos ? 0 : std::atoi(name.c_str() + dot + 1);
}

std::vector<std::string> checkpoints(const RunDirectory& run) {
  std::vector<std::string> names;
  for (const auto& [name, entry] : run.manifest())
    if (name.starts_with("checkpoints/")) names.push_back(name);
  return names;
}

/// Puts the world at the newest checkpoint that is whole and has all frames before it.
void continueFrom(RunDirectory& run, World& world) {
  const std::vector<std::string> names = checkpoints(run);
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    const std::filesystem::path file = run.path() / *name;
    if (frameOfCheckpoint(*name) > run.lastFrame() || !std::filesystem::exists(file)) continue;
    const std::string bytes = readFile(file);
    ContentHash hash;
    hash.add(bytes);
    if (hash.hex() != run.manifest().at(*name).file.hash) continue;
    return world.restore(bytes, file.string());
  }
}

/// Writes this frame's checkpoint, then forgets the older ones but the last `keep`.
void saveCheckpoint(RunDirectory& run, const World& world, std::size_t keep) {
  run.add(checkpointName(world.frameIndex()), world.checkpoint());
  std::vector<std::string> names = checkpoints(run);
  names.resize(names.size() > keep ? names.size() - keep : 0);
  if (!names.empty()) run.remove(names);
}

/// One frame; where it fails, with the name of what is left to go back to.
void advanceFrom(const RunDirectory& run, World& world) {
  try {
    world.advance();
  } catch (const Error& error) {
    if (error.code != ExitCode::unstable) throw;
    const std::vector<std::string> names = checkpoints(run);
    throw Error(error.code,
                fmt::format("{}; {}", error.what(),
                            names.empty() ? "there is no checkpoint yet"
                                          : "last good checkpoint: " + (run.path() / names.back()).string()));
  }
}

void summarise(const World& world, SimulationSummary& summary) {
  const RunTotals& totals = world.totals();
  summary.volume = totals.volume;
  summary.heat = totals.heat;
  summary.courant = totals.courant;
  summary.divergence = totals.divergence;
  summary.substeps = static_cast<int>(totals.substeps);
}

/// A frame's files, with the seconds it took.
void writeFrame(RunDirectory& run, const World& world, SimulationSummary& summary) {
  Stopwatch watch;
  {
    const Frame frame = world.capture();
    run.addFrame(frame);
    for (const auto& [stage, seconds] : frame.report.stageSeconds) summary.stageSeconds[stage] += seconds;
  }
  releaseFreedMemory();
  summary.stageSeconds["write"] += watch.lap();
}
}  // namespace

SimulationSummary simulate(const SimulationSettings& settings, RunDirectory& run, const SimulateOptions& options) {
  SimulationSummary summary;
  Stopwatch watch;
  const int last = options.lastFrame > 0 ? std::min(options.lastFrame, settings.frames) : settings.frames;
  World world(settings);
  summary.stageSeconds["fracture"] = watch.lap();
  if (run.manifest().contains("pieces.glb")) continueFrom(run, world);
  if (world.frameIndex() == 1) {
    run.add("pieces.glb", piecesToGlb(world.capture().bodies));
    writeFrame(run, world, summary);
  }
  constexpr std::size_t whileRunning = 2, whenDone = 1;
  while (world.frameIndex() < last) {
    if (options.progress) options.progress("simulate", world.frameIndex(), last);
    if (options.stopRequested && options.stopRequested()) {
      summary.interrupted = true;
      break;
    }
    advanceFrom(run, world);
    writeFrame(run, world, summary);
    if (world.frameIndex() % settings.checkpointEvery == 0 && world.frameIndex() < last)
      saveCheckpoint(run, world, whileRunning);
  }
  saveCheckpoint(run, world, summary.interrupted ? whileRunning : whenDone);
  if (options.progress && !summary.interrupted) options.progress("simulate", last, last);
  summary.frames = run.lastFrame();
  summarise(world, summary);
  return summary;
}

}  // namespace brisance
