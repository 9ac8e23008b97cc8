// The commands that make something: run, simulate, render, encode.
#include <algorithm>
#include <cstdio>

#include "base/check.h"
#include "base/stopwatch.h"
#include "commands.h"
#include "interruption.h"
#include "prepared_run.h"
#include "progress_bar.h"
#include "render/render_run.h"
#include "run_record.h"
#include "scene/film.h"
#include "typed_scene.h"

namespace brisance {

namespace {

namespace fs = std::filesystem;

/// One command's work on one run.
struct Work {
  const Options& options;
  const Scene& scene;
  RunDirectory& run;
  ProgressBar& bar;
  RunRecord& record;
};

ProgressSink sinkOf(ProgressBar& bar) {
  return [&bar](const std::string& stage, int done, int total) { bar.show(stage, done, total); };
}

/// True when it came to its end.
bool simulateStage(Work& work) {
  const Stopwatch watch;
  SimulateOptions options;
  options.lastFrame = work.options.frames ? work.options.frames->last : 0;
  options.progress = sinkOf(work.bar);
  options.stopRequested = interruptionRequested;
  const SimulationSummary summary = simulate(work.scene.simulation, work.run, options);
  work.record.addSimulation(summary, watch.seconds());
  work.record.write();
  return !summary.interrupted;
}

bool renderStage(Work& work) {
  const FrameRange frames = work.options.frames.value_or(FrameRange{});
  RenderRunOptions options;
  options.firstFrame = frames.first;
  options.lastFrame = frames.last;
  options.step = frames.step;
  options.skipExisting = work.options.skipExisting || work.options.existing == ExistingRun::resume;
  options.fps = work.scene.film.fps;
  options.timeScale = work.scene.film.timeScale;
  options.progress = sinkOf(work.bar);
  options.stopRequested = interruptionRequested;
  const RenderSummary summary = renderRun(work.run, work.scene.render, options);
  work.record.addStage("render", {{"total", summary.seconds}});
  work.record.write();
  return !summary.interrupted;
}

bool encodeStage(Work& work) {
  const Stopwatch watch;
  work.bar.show("encode", 0, 1);
  const Film film = encodeFilm(work.run, work.scene.film);
  work.bar.show("encode", 1, 1);
  work.record.addStage("encode", {{"total", watch.seconds()}});
  work.record.setFilm(film.frames);
  work.record.write();
  return true;
}

using Stage = bool (*)(Work&);

int doStages(const Options& options, const Scene& scene, RunDirectory& run, const std::vector<Stage>& stages) {
  ProgressBar bar(ProgressBar::styleFor(options.quiet));
  RunRecord record(run, scene);
  Work work{options, scene, run, bar, record};
  for (const Stage stage : stages) {
    const bool ended = stage(work);
    bar.endLine();
    if (!ended || interruptionRequested()) return interruptionExitCode();
  }
  if (options.json)
    fmt::print("{}\n", record.inOneLine());
  else if (!options.quiet)
    fmt::print("{}", record.summary());
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int runCommand(const Options& options) {
  const Scene scene = sceneAsTyped(options);
  const fs::path path = options.output.empty() ? fs::path("runs") / options.path.stem() : options.output;
  const FrameRange frames = options.frames.value_or(FrameRange{});
  std::vector<Stage> stages{simulateStage, renderStage};
  // A film has no gaps: of other frames there are pictures alone.
  if (frames.first == 1 && frames.step == 1) stages.push_back(encodeStage);
  RunDirectory run = prepareRun(scene, path, options.existing);
  return doStages(options, scene, run, stages);
}

int simulateCommand(const Options& options) {
  if (options.frames && (options.frames->first != 1 || options.frames->step != 1))
    throw InputError(fmt::format("brisance: --frames: a simulation begins at frame 1 and leaves none out, like 1-{}",
                                 options.frames->last));
  const Scene scene = sceneAsTyped(options);
  RunDirectory run = prepareRun(scene, options.output, options.existing);
  return doStages(options, scene, run, {simulateStage});
}

int renderCommand(const Options& options) {
  const Scene scene = sceneOfRun(options);
  RunDirectory run(options.path, RunDirectory::Mode::share);
  return doStages(options, scene, run, {renderStage});
}

int encodeCommand(const Options& options) {
  const Scene scene = sceneOfRun(options);
  RunDirectory run(options.path, RunDirectory::Mode::open);
  return doStages(options, scene, run, {encodeStage});
}

std::string continuingOption(const std::string& command) {
  if (command == "run" || command == "simulate" || command == "farm") return "--resume";
  return command == "render" ? "--skip-existing" : "";
}

}  // namespace brisance
