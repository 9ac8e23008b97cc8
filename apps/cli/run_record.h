// run.json: what a run was made of and with, and what it cost (docs/files.md).
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "frame/run_directory.h"
#include "scene/scene_file.h"
#include "simulation/simulate.h"

namespace brisance {

/// Seconds of wall time by part; "total" is the whole stage.
using StageSeconds = std::map<std::string, double>;

/// The account of a run, gathered stage by stage; what earlier commands wrote is kept.
class RunRecord {
 public:
  /// Continues the run.json that is there.
  RunRecord(RunDirectory& run, const Scene& scene);
  ~RunRecord();

  void addSimulation(const SimulationSummary& summary, double seconds);
  /// Adds to the seconds of "render" or "encode".
  void addStage(const std::string& stage, const StageSeconds& seconds);
  void setPictures(int pictures);
  void setFilm(int frames);

  /// Writes run.json durably, with the memory that this process needed so far.
  void write();
  /// The content of run.json, in one line.
  std::string inOneLine() const;
  /// A few lines for people: seconds of each stage, balances, and where the film lies.
  std::string summary() const;

 private:
  RunDirectory& run_;
  std::unique_ptr<nlohmann::json> record_;
};

/// Most memory that this process held [bytes].
std::int64_t peakMemory();

}  // namespace brisance
