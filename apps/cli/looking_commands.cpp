// The commands that only look: check, info, verify.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/check.h"
#include "commands.h"
#include "frame/run_directory.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_report.h"
#include "scene/estimate.h"

namespace brisance {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void print(const Options& options, const std::string& text, const std::string& asJson) {
  fmt::print("{}{}", options.json ? asJson : text, options.json || !text.ends_with('\n') ? "\n" : "");
}

std::int64_t bytesOf(const std::map<std::string, ManifestEntry>& manifest) {
  std::int64_t bytes = 0;
  for (const auto& [name, entry] : manifest) bytes += static_cast<std::int64_t>(entry.file.size);
  return bytes;
}

int filesWith(const std::map<std::string, ManifestEntry>& manifest, const std::string& start, const std::string& end) {
  return static_cast<int>(std::count_if(manifest.begin(), manifest.end(), [&](const auto& item) {
    return item.first.starts_with(start) && item.first.ends_with(end);
  }));
}

int describeRun(const Options& options) {
  const auto manifest = readManifest(options.path);
  json facts = {{"kind", "run"},
                {"frames", filesWith(manifest, "gas/", ".vdb")},
                {"pictures", filesWith(manifest, "images/", ".png")},
                {"film", manifest.contains("film.mp4")},
                {"files", manifest.size()},
                {"bytes", bytesOf(manifest)}};
  std::string text =
      fmt::format("run: {} frames, {} pictures, {} film; {} files, {:.1f} MB", facts["frames"].get<int>(),
                  facts["pictures"].get<int>(), facts["film"].get<bool>() ? "a" : "no", manifest.size(),
                  static_cast<double>(bytesOf(manifest)) / 1e6);
  if (manifest.contains("run.json")) facts["run"] = json::parse(readFile(options.path / "run.json"));
  print(options, text, facts.dump());
  return static_cast<int>(ExitCode::done);
}

int describeMesh(const Options& options) {
  const MeshReport report = examine(readMesh(options.path));
  print(options, meshReportText(report), meshReportJson(report));
  return static_cast<int>(ExitCode::done);
}

int describeScene(const Options& options) {
  const Scene scene = readScene(options.path);
  const SceneEstimate cost = estimate(scene);
  json facts = json::parse(checkJson({cost, {}, ExitCode::done}));
  facts["kind"] = "scene";
  print(options, estimateText(cost), facts.dump());
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int checkCommand(const Options& options) {
  const SceneCheck check =
      checkScene(options.path, options.overrides, options.output.empty() ? fs::path(".") : options.output);
  if (options.json) fmt::print("{}\n", checkJson(check));
  if (!options.json && check.cost) fmt::print("{}", estimateText(*check.cost));
  for (const std::string& problem : check.problems) fmt::print(stderr, "{}\n", problem);
  return static_cast<int>(check.ok() ? ExitCode::done : check.code);
}

int infoCommand(const Options& options) {
  if (!fs::exists(options.path))
    throw InputError(
        fmt::format("{}: does not exist; name a run directory, a scene or a mesh file", options.path.string()));
  if (fs::is_directory(options.path)) return describeRun(options);
  return namesMeshFile(options.path) ? describeMesh(options) : describeScene(options);
}

int verifyCommand(const Options& options) {
  const std::size_t files = readManifest(options.path).size();
  const std::vector<std::string> problems = verifyRun(options.path);
  if (options.json)
    fmt::print("{}\n", json{{"ok", problems.empty()}, {"files", files}, {"problems", problems}}.dump());
  else if (problems.empty())
    fmt::print("{}: {} files, all as they were written\n", options.path.string(), files);
  for (const std::string& problem : problems) fmt::print(stderr, "{}\n", problem);
  return static_cast<int>(problems.empty() ? ExitCode::done : ExitCode::badInput);
}

}  // namespace brisance
