#include "run_record.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include "base/parallel.h"
#include "base/vector_path.h"

namespace brisance {

namespace {

using nlohmann::json;

constexpr const char* recordName = "run.json";
constexpr double bytesPerMegabyte = 1e6;

/// The account that earlier commands wrote; empty where there is none or it is not the one of the manifest.
json earlierRecord(const RunDirectory& run) {
  const auto entry = run.manifest().find(recordName);
  if (entry == run.manifest().end()) return json::object();
  const std::string text = readFile(run.path() / recordName);
  ContentHash hash;
  hash.add(text);
  return hash.hex() == entry->second.file.hash ? json::parse(text) : json::object();
}

std::string hostName() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string vectorPathName() {
  switch (vectorPath()) {
    case VectorPath::avx512:
      return "avx512";
    case VectorPath::avx2:
      return "avx2";
    case VectorPath::plain:
      break;
  }
  return "plain";
}

json asJson(const Balance& balance) {
  return {{"in", balance.in},
          {"gained", balance.gained},
          {"out", balance.out},
          {"lost", balance.lost},
          {"error", balance.error()}};
}

int countPictures(const RunDirectory& run) {
  const auto isPicture = [](const auto& item) {
    return item.first.starts_with("images/") && item.first.ends_with(".png");
  };
  return static_cast<int>(std::count_if(run.manifest().begin(), run.manifest().end(), isPicture));
}

void addSeconds(json& stage, const StageSeconds& seconds) {
  for (const auto& [part, value] : seconds)
    stage[part] = (stage.contains(part) ? stage[part].get<double>() : 0.0) + value;
}

}  // namespace

RunRecord::RunRecord(RunDirectory& run, const Scene& scene)
    : run_(run), record_(std::make_unique<json>(earlierRecord(run))) {
  const std::uint64_t seed = scene.simulation.seed;
  news_.emplace_back([seed](json& record) {
    record["version"] = BRISANCE_VERSION;
    record["seed"] = seed;
    record["host"] = hostName();
    record["threads"] = threadCount();
    record["vector"] = vectorPathName();
    if (!record.contains("seconds")) record["seconds"] = json::object();
  });
}

RunRecord::~RunRecord() = default;

void RunRecord::addSimulation(const SimulationSummary& summary, double seconds) {
  news_.emplace_back([summary, seconds](json& record) {
    record["frames"] = summary.frames;
    record["substeps"] = summary.substeps;
    record["courant"] = summary.courant;
    record["divergence"] = summary.divergence;
    record["fire_went_out"] = summary.fireWentOut;
    record["balances"] = {{"volume", asJson(summary.volume)}, {"heat", asJson(summary.heat)}};
    addSeconds(record["seconds"]["simulate"], summary.stageSeconds);
    addSeconds(record["seconds"]["simulate"], {{"total", seconds}});
  });
}

void RunRecord::addStage(const std::string& stage, const StageSeconds& seconds) {
  news_.emplace_back([stage, seconds](json& record) { addSeconds(record["seconds"][stage], seconds); });
}

void RunRecord::setFilm(int frames) {
  news_.emplace_back([frames](json& record) { record["film"] = {{"file", "film.mp4"}, {"frames", frames}}; });
}

void RunRecord::write() {
  run_.inTurn([this] {
    json record = earlierRecord(run_);
    for (const News& news : news_) news(record);
    if (const int pictures = countPictures(run_); pictures > 0) record["pictures"] = pictures;
    const double earlier = record.value("peak_memory_mb", 0.0);
    record["peak_memory_mb"] = std::max(earlier, static_cast<double>(peakMemory()) / bytesPerMegabyte);
    run_.add(recordName, record.dump(2) + "\n");
    *record_ = std::move(record);
    news_.clear();
  });
}

std::string RunRecord::inOneLine() const { return record_->dump(); }

std::string RunRecord::summary() const {
  const json& record = *record_;
  std::string text = fmt::format("{}: {} frames, {:.0f} MB at the peak\n", run_.path().string(),
                                 record.value("frames", 0), record.value("peak_memory_mb", 0.0));
  if (record.value("fire_went_out", false))
    text += "fire      went out: only the fuel that was lit has burnt (try finer gas.cells, or more lit)\n";
  for (const char* stage : {"simulate", "render", "encode"})
    if (record["seconds"].contains(stage))
      text += fmt::format("{:<9} {:8.1f} s\n", stage, record["seconds"][stage].value("total", 0.0));
  if (record.contains("film"))
    text += fmt::format("film      {} ({} frames)\n", (run_.path() / "film.mp4").string(),
                        record["film"]["frames"].get<int>());
  return text;
}

std::int64_t peakMemory() {
  constexpr std::int64_t bytesPerUnit = 1024;  // ru_maxrss counts kibibytes on Linux
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * bytesPerUnit;
}

}  // namespace brisance
