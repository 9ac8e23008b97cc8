#include "simulation/simulate.h"

#include "base/memory.h"
#include "base/stopwatch.h"
#include "frame/gltf_export.h"
#include "simulation/run_writer.h"
#include "simulation/world_state.h"

namespace brisance {

namespace {
int frameOfCheckpoint(const std::string& name) {
  const std::size_t dot = name.find('.');
  return dot == std::string::npos ? 0 : std::atoi(name.c_str() + dot + 1);
}

/// Puts the world at the newest checkpoint that is whole and has all frames before it.
void continueFrom(RunDirectory& run, World& world) {
  const std::vector<std::string> names = checkpointsOf(run);
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

/// One frame; where it fails, with the name of what is left to go back to.
void advanceFrom(const RunDirectory& run, RunWriter& writer, World& world) {
  try {
    world.advance();
  } catch (const Error& error) {
    if (error.code != ExitCode::unstable) throw;
    writer.wait();
    const std::vector<std::string> names = checkpointsOf(run);
    throw Error(error.code,
                fmt::format("{}; {}", error.what(),
                            names.empty() ? "there is no checkpoint yet"
                                          : "last good checkpoint: " + (run.path() / names.back()).string()));
  }
}

/// Whether as much gas was made as the fuel gives that was lit at the start, though there was more.
bool fireWentOut(const ParticleSettings& particles, double gasMade) {
  double lit = 0, more = 0;
  for (const Charge& charge : particles.charges) {
    lit += std::min(charge.ignited, charge.particles);
    more += std::max(charge.particles - charge.ignited, 0) + charge.emissionRate * charge.emissionTime;
  }
  const double ofLit = lit * particles.burning.mass * particles.burning.gasPerMass;
  constexpr double rounding = 1e-3;
  return ofLit > 0 && more > 0 && std::abs(gasMade - ofLit) < rounding * ofLit;
}

void summarise(const World& world, const ParticleSettings& particles, SimulationSummary& summary) {
  const RunTotals& totals = world.totals();
  summary.volume = totals.volume;
  summary.heat = totals.heat;
  summary.courant = totals.courant;
  summary.divergence = totals.divergence;
  summary.substeps = static_cast<int>(totals.substeps);
  summary.fireWentOut = fireWentOut(particles, totals.volume.in);
}

constexpr std::size_t keptWhileRunning = 2, keptWhenDone = 1;  // checkpoints

/// The world as it is now.
StagedFile stage(const RunDirectory& run, const World& world) {
  return stageCheckpoint(run, world.frameIndex(), [&](std::ostream& out) { world.checkpoint(out); });
}

/// Hands a frame over to be written; counts the seconds in which nothing is simulated for it.
void writeFrame(RunDirectory& run, RunWriter& writer, const World& world, const SimulationSettings& settings, int last,
                SimulationSummary& summary) {
  Stopwatch watch;
  writer.wait();  // first, so that the memory of one frame suffices
  const bool done = world.frameIndex() == last, checkpoint = done || world.frameIndex() % settings.checkpointEvery == 0;
  FrameToWrite files{{}, {}, done ? keptWhenDone : keptWhileRunning};
  {
    const Frame frame = world.captureWithoutGas();
    for (const auto& [stage, seconds] : frame.report.stageSeconds) summary.stageSeconds[stage] += seconds;
    files.files = filesOf(frame, world.gas());
  }
  if (checkpoint) files.checkpoint = stage(run, world);
  writer.write(std::move(files));
  summary.stageSeconds["write"] += watch.lap();
}

/// What is still on its way; then there is a checkpoint of this moment, and none that a run killed before it could
/// remove them has left.
void finishWriting(RunDirectory& run, RunWriter& writer, const World& world, SimulationSummary& summary) {
  Stopwatch watch;
  writer.wait();
  const std::vector<std::string> names = checkpointsOf(run);
  if (names.empty() || frameOfCheckpoint(names.back()) != world.frameIndex()) run.add(stage(run, world));
  keepNewestCheckpoints(run, summary.interrupted ? keptWhileRunning : keptWhenDone);
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
  RunWriter writer(run);
  if (world.frameIndex() == 1) {
    run.add("pieces.glb", piecesToGlb(world.captureWithoutGas().bodies));
    writeFrame(run, writer, world, settings, last, summary);
  }
  while (world.frameIndex() < last) {
    if (options.progress) options.progress("simulate", world.frameIndex(), last);
    if (options.stopRequested && options.stopRequested()) {
      summary.interrupted = true;
      break;
    }
    advanceFrom(run, writer, world);
    writeFrame(run, writer, world, settings, last, summary);
  }
  finishWriting(run, writer, world, summary);
  if (options.progress && !summary.interrupted) options.progress("simulate", last, last);
  summary.frames = run.lastFrame();
  summarise(world, settings.particles, summary);
  return summary;
}

}  // namespace brisance
