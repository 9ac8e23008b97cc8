// run.json: what a run was made of and with, and what it cost (docs/files.md).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "frame/run_directory.h"
#include "scene/scene_file.h"
#include "simulation/simulate.h"

namespace brisance {

/// Seconds of wall time by part; "total" is the whole stage.
using StageSeconds = std::map<std::string, double>;

/// The account of a run, gathered stage by stage; what earlier commands wrote is kept, and what others write
/// meanwhile.
class RunRecord {
 public:
  RunRecord(RunDirectory& run, const Scene& scene);
  ~RunRecord();

  void addSimulation(const SimulationSummary& summary, double seconds);
  /// Adds to the seconds of "render" or "encode".
  void addStage(const std::string& stage, const StageSeconds& seconds);
  void setFilm(int frames);

  /// Adds what is new to the run.json that is there, durably: also the number of pictures, and the memory that this
  /// process needed so far.
  void write();
  /// The content of run.json, in one line.
  std::string inOneLine() const;
  /// A few lines for people: seconds of each stage, balances, and where the film lies.
  std::string summary() const;

 private:
  using News = std::function<void(nlohmann::json&)>;
  RunDirectory& run_;
  std::unique_ptr<nlohmann::json> record_;  ///< as last written
  std::vector<News> news_;                  ///< since then
};

/// Most memory that this process held [bytes].
std::int64_t peakMemory();

}  // namespace brisance
