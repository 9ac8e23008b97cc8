// Slurm: one script for each job, several tasks as a job array.
#include <cctype>
#include <cstdio>

#include "base/check.h"
#include "base/durable_file.h"
#include "farm_engine.h"
#include "scene/run_program.h"
#include "shell_words.h"

namespace brisance {
namespace {

/// Slurm puts numbers in place of %a and its like in the names of logs.
std::string withoutPatterns(const std::string& path) {
  std::string text;
  for (const char letter : path) text += letter == '%' ? std::string("%%") : std::string(1, letter);
  return text;
}

class SlurmEngine : public FarmEngine {
 public:
  explicit SlurmEngine(const FarmSettings& settings) : settings_(settings) {}

  std::string submit(const FarmJob& job) override {
    const std::filesystem::path script = settings_.folder / fmt::format("{}.sh", stemOf(job));
    const std::vector<std::string> command = submission(job, script);
    if (settings_.dryRun) {
      fmt::print("# {}\n{}\n{}\n", script.string(), scriptOf(job), shellLine(command));
      return job.name;
    }
    writeDurably(script, scriptOf(job));
    return idIn(runProgram(command, {"farm", "slurm-client"}));
  }

 private:
  std::string stemOf(const FarmJob& job) const { return fmt::format("{}.{}", job.name, settings_.round); }

  static std::string scriptOf(const FarmJob& job) {
    if (job.tasks.size() == 1) return fmt::format("#!/bin/sh\nexec {}\n", shellLine(job.tasks.front()));
    std::string text = "#!/bin/sh\ncase \"$SLURM_ARRAY_TASK_ID\" in\n";
    for (std::size_t n = 0; n < job.tasks.size(); ++n)
      text += fmt::format("{}) exec {} ;;\n", n, shellLine(job.tasks[n]));
    return text + "esac\n";
  }

  std::vector<std::string> submission(const FarmJob& job, const std::filesystem::path& script) const {
    const bool isArray = job.tasks.size() > 1;
    const std::filesystem::path log = settings_.folder / (stemOf(job) + (isArray ? ".%a.log" : ".log"));
    std::vector<std::string> words{
        "sbatch", "--parsable", fmt::format("--job-name={}-{}", settings_.run, job.name),
        "--output=" + withoutPatterns(settings_.folder.string()) + "/" + log.filename().string()};
    words.push_back("--chdir=" + settings_.folder.string());
    if (isArray) words.push_back(fmt::format("--array=0-{}", job.tasks.size() - 1) + limitOfArray());
    if (settings_.cores > 0) words.push_back(fmt::format("--cpus-per-task={}", settings_.cores));
    if (!settings_.partition.empty()) words.push_back("--partition=" + settings_.partition);
    if (!job.after.empty())
      words.push_back(fmt::format("--dependency={}:{}", job.evenAfterFailure ? "afterany" : "afterok", job.after));
    words.emplace_back("--kill-on-invalid-dep=yes");
    words.insert(words.end(), settings_.submitted.begin(), settings_.submitted.end());
    words.push_back(script.string());
    return words;
  }
  std::string limitOfArray() const { return settings_.atOnce > 0 ? fmt::format("%{}", settings_.atOnce) : ""; }

  /// "17\n", or "17;cluster\n"
  static std::string idIn(const std::string& answer) {
    std::size_t digits = 0;
    while (digits < answer.size() && std::isdigit(static_cast<unsigned char>(answer[digits])) != 0) ++digits;
    if (digits == 0) throw Error(ExitCode::failed, "farm: sbatch gave no number of a job");
    return answer.substr(0, digits);
  }

  FarmSettings settings_;
};

}  // namespace

std::unique_ptr<FarmEngine> slurmEngine(const FarmSettings& settings) {
  return std::make_unique<SlurmEngine>(settings);
}

}  // namespace brisance
