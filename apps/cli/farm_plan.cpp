#include "farm_plan.h"

#include <fmt/format.h>

#include "frame/manifest.h"
#include "render/render_run.h"

namespace brisance {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

void append(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

/// This very program, which all machines must find in the same place.
std::string programPath() { return fs::read_symlink("/proc/self/exe"); }

Words command(const std::string& name, const fs::path& path, const Options& options) {
  Words words{programPath(), name, path.string(), "--quiet"};
  if (options.farm.cores > 0 && name != "farm") append(words, {"--threads", fmt::format("{}", options.farm.cores)});
  return words;
}

/// Where the run was made from a scene, these stand in it already.
Words pictureOptions(const Options& options) {
  Words words;
  if (!options.farm.scene.empty()) return words;
  if (options.size) append(words, {"--size", fmt::format("{}x{}", options.size->width, options.size->height)});
  if (options.samples) append(words, {"--samples", fmt::format("{}", *options.samples)});
  for (const std::string& key : options.overrides) append(words, {"--set", key});
  return words;
}

Words simulation(const Options& options) {
  Words words = command("simulate", options.path / "scene.toml", options);
  append(words, {"-o", options.path.string(), "--resume"});
  return words;
}

Words pictures(const FrameRange& chunk, const Options& options) {
  Words words = command("render", options.path, options);
  append(words, {"--skip-existing", "--frames", fmt::format("{}-{}", chunk.first, chunk.last)});
  append(words, pictureOptions(options));
  return words;
}

/// The same farm, one round on.
Words check(const Options& options) {
  const FarmOptions& farm = options.farm;
  Words words = command("farm", options.path, options);
  append(words, {"--engine", farm.engine, "--check", "--round", fmt::format("{}", farm.round + 1)});
  append(words, {"--rounds", fmt::format("{}", farm.rounds), "--chunk", fmt::format("{}", farm.chunk)});
  if (farm.cores > 0) append(words, {"--cores", fmt::format("{}", farm.cores)});
  if (farm.atOnce > 0) append(words, {"--at-once", fmt::format("{}", farm.atOnce)});
  if (!farm.partition.empty()) append(words, {"--partition", farm.partition});
  for (const std::string& option : farm.submitted) words.push_back("--submit=" + option);
  append(words, pictureOptions(options));
  return words;
}

}  // namespace

FarmNeeds needsOf(const fs::path& run, const Scene& scene) {
  FarmNeeds needs;
  const auto manifest = fs::exists(run / manifestName) ? readManifest(run) : std::map<std::string, ManifestEntry>();
  const int frames = scene.simulation.frames;
  needs.simulation = lastWholeFrame(manifest) < frames;
  for (int frame = 1; frame <= frames; ++frame)
    if (!hasPicture(run, manifest, frame, scene.render)) needs.pictures.push_back(frame);
  needs.film = !manifest.contains("film.mp4");
  return needs;
}

std::vector<FrameRange> chunksOf(const std::vector<int>& frames, int most) {
  std::vector<FrameRange> chunks;
  for (const int frame : frames) {
    const bool goesOn = !chunks.empty() && chunks.back().last + 1 == frame && frame - chunks.back().first < most;
    if (goesOn)
      chunks.back().last = frame;
    else
      chunks.push_back({frame, frame, 1});
  }
  return chunks;
}

std::string textOfFrames(const std::vector<int>& frames) {
  std::string text;
  for (const FrameRange& range : chunksOf(frames, static_cast<int>(frames.size()))) {
    if (!text.empty()) text += ", ";
    text += range.first == range.last ? fmt::format("{}", range.first) : fmt::format("{}-{}", range.first, range.last);
  }
  return text;
}

std::vector<PlannedJob> planOf(const FarmNeeds& needs, const Options& options) {
  std::vector<PlannedJob> plan;
  const auto add = [&](const std::string& name, std::vector<Words> tasks, bool evenAfterFailure = false) {
    plan.push_back({{name, std::move(tasks), "", evenAfterFailure}, static_cast<int>(plan.size()) - 1});
  };
  if (needs.simulation) add("simulate", {simulation(options)});
  std::vector<Words> tasks;
  for (const FrameRange& chunk : chunksOf(needs.pictures, options.farm.chunk))
    tasks.push_back(pictures(chunk, options));
  if (!tasks.empty()) add("render", std::move(tasks));
  if (!plan.empty()) add("check", {check(options)}, true);
  add("encode", {command("encode", options.path, options)});
  return plan;
}

}  // namespace brisance
