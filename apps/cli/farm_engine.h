// Who runs the jobs of a film. An engine is one small file; farm_command.cpp lists them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace brisance {

/// Its tasks may run anywhere that sees the run, in any order, and more than once.
struct FarmJob {
  std::string name;                             ///< "render"
  std::vector<std::vector<std::string>> tasks;  ///< a command line each
  std::string after;                            ///< id of the job that it waits for; empty: none
  bool evenAfterFailure = false;                ///< of that job; else it is then given up
};

/// What the user says of all jobs.
struct FarmSettings {
  std::filesystem::path folder;        ///< for scripts and logs; absolute, and there
  std::string run;                     ///< the run's name, for people
  int round = 1;                       ///< of making up for what is missing
  int cores = 0;                       ///< for each task; 0: the engine's choice
  int atOnce = 0;                      ///< tasks of a job at the same time; 0: the engine's choice
  std::string partition;               ///< empty: the engine's choice
  std::vector<std::string> submitted;  ///< further options, handed on as they are
  bool dryRun = false;                 ///< print what would be written and called, and do nothing
};

class FarmEngine {
 public:
  virtual ~FarmEngine() = default;
  /// Takes the job on and returns its id. Throws Error.
  virtual std::string submit(const FarmJob& job) = 0;
};

/// Slurm, by sbatch.
std::unique_ptr<FarmEngine> slurmEngine(const FarmSettings& settings);
/// Processes on this machine; a job has come to its end when submit() returns.
std::unique_ptr<FarmEngine> localEngine(const FarmSettings& settings);

}  // namespace brisance
