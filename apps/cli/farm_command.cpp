// brisance farm: the stages of a film as jobs of an engine.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/check.h"
#include "base/durable_file.h"
#include "commands.h"
#include "farm_plan.h"
#include "interruption.h"
#include "prepared_run.h"
#include "typed_scene.h"

namespace brisance {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::unique_ptr<FarmEngine> engineOf(const Options& options) {
  const FarmOptions& farm = options.farm;
  FarmSettings settings{options.path / "farm", options.path.filename(), farm.round,     farm.cores,
                        farm.atOnce,           farm.partition,          farm.submitted, farm.dryRun};
  if (!farm.dryRun) makeDirectories(settings.folder);
  return farm.engine == "slurm" ? slurmEngine(settings) : localEngine(settings);
}

/// The scene of a run that is there, or that is made now so that jobs need nothing else.
Scene sceneOf(const Options& options) {
  if (options.farm.scene.empty()) return sceneOfRun(options);
  Options typed = options;
  typed.path = options.farm.scene;
  Scene scene = sceneAsTyped(typed);
  if (!options.farm.dryRun) prepareRun(scene, options.path, options.existing);
  return scene;
}

/// Ids of the jobs in `answer`, and a line for each.
void submitAll(const std::vector<PlannedJob>& plan, const Options& options, json& answer) {
  const std::unique_ptr<FarmEngine> engine = engineOf(options);
  std::vector<std::string> ids;
  for (const auto& [job, after] : plan) {
    FarmJob next = job;
    if (after >= 0) next.after = ids[after];
    ids.push_back(engine->submit(next));
    answer["jobs"].push_back({{"name", job.name}, {"id", ids.back()}, {"tasks", job.tasks.size()}});
    if (!options.json && !options.quiet && !options.farm.dryRun)
      fmt::print("{:<9} {}{}\n", job.name, ids.back(),
                 job.tasks.size() > 1 ? fmt::format(", {} tasks", job.tasks.size()) : "");
    if (interruptionRequested()) return;
  }
}

std::string lackOf(const FarmNeeds& needs) {
  std::string text = needs.simulation ? "the simulation has not come to its end" : "";
  if (!needs.pictures.empty())
    text += fmt::format("{}missing pictures: {}", text.empty() ? "" : "; ", textOfFrames(needs.pictures));
  return text;
}

/// The job between pictures and film: good, or what is missing is submitted again and this one fails, so that the
/// film that waits for it is given up for the one of the next round.
int checkAndMakeUp(const FarmNeeds& needs, const Options& options) {
  const std::string run = options.path.string(), lack = lackOf(needs);
  if (lack.empty()) return static_cast<int>(ExitCode::done);
  const FarmOptions& farm = options.farm;
  if (farm.round > farm.rounds)
    throw Error(ExitCode::failed, fmt::format("{}: {}; given up after {} rounds, {} has the logs", run, lack,
                                              farm.rounds, (options.path / "farm").string()));
  json jobs;
  submitAll(planOf(needs, options), options, jobs);
  throw Error(ExitCode::failed, fmt::format("{}: {}; submitted again, round {}", run, lack, farm.round));
}

/// An engine that has done all by now is taken at its word only so far.
void requireFilm(const Options& options, const Scene& scene) {
  const FarmNeeds left = needsOf(options.path, scene);
  if (!left.nothing())
    throw Error(ExitCode::failed, fmt::format("{}: {}; {} has the logs", options.path.string(),
                                              lackOf(left).empty() ? "there is no film" : lackOf(left),
                                              (options.path / "farm").string()));
}

int say(const json& answer, const FarmNeeds& needs, const Options& options) {
  if (options.json)
    fmt::print("{}\n", answer.dump());
  else if (needs.nothing() && !options.quiet)
    fmt::print("{}: nothing is missing\n", options.path.string());
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int farmCommand(const Options& typed) {
  Options options = typed;
  options.path = fs::absolute(typed.path).lexically_normal();
  if (!options.path.has_filename()) options.path = options.path.parent_path();  // "RUN/"
  const Scene scene = sceneOf(options);
  const FarmNeeds needs = needsOf(options.path, scene);
  if (options.farm.check) return checkAndMakeUp(needs, options);
  json answer{{"engine", options.farm.engine},
              {"simulation", needs.simulation},
              {"pictures", needs.pictures},
              {"jobs", json::array()}};
  if (!needs.nothing()) submitAll(planOf(needs, options), options, answer);
  if (interruptionRequested()) return interruptionExitCode();
  if (options.farm.engine == "local" && !options.farm.dryRun) requireFilm(options, scene);
  return say(answer, needs, options);
}

}  // namespace brisance
