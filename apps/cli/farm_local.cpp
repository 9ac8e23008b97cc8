// This machine as a farm: each task is a process.
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <thread>

#include "base/check.h"
#include "farm_engine.h"
#include "interruption.h"
#include "shell_words.h"

namespace brisance {
namespace {

using namespace std::chrono_literals;

/// Runs a command with what it says in a log. Returns the process.
pid_t start(std::vector<std::string> command, const std::filesystem::path& log) {
  std::vector<char*> words;
  words.reserve(command.size() + 1);
  for (std::string& word : command) words.push_back(word.data());
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw Error(ExitCode::failed, "farm: cannot start a process");
  if (child > 0) return child;
  const int nothing = open("/dev/null", O_RDONLY);
  const int said = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  if (said >= 0) dup2(said, STDOUT_FILENO), dup2(said, STDERR_FILENO);
  execv(words[0], words.data());
  constexpr int missingTool = 127;
  _exit(missingTool);
}

/// Tasks at work.
class Crew {
 public:
  void add(pid_t process) { working_.push_back(process); }
  std::size_t size() const { return working_.size(); }
  bool allWell() const { return allWell_; }
  /// Waits until one more has come to its end. A wish to stop is passed on.
  void waitForOne() {
    const std::size_t before = working_.size();
    while (working_.size() == before) {
      std::erase_if(working_, [this](pid_t process) { return hasEnded(process); });
      if (interruptionRequested() && !told_) tell();
      if (working_.size() == before) std::this_thread::sleep_for(20ms);
    }
  }

 private:
  bool hasEnded(pid_t process) {
    int status = 0;
    if (waitpid(process, &status, WNOHANG) == 0) return false;
    allWell_ = allWell_ && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return true;
  }
  void tell() {
    for (const pid_t process : working_) kill(process, SIGTERM);
    told_ = true;
  }

  std::vector<pid_t> working_;
  bool allWell_ = true, told_ = false;
};

class LocalEngine : public FarmEngine {
 public:
  explicit LocalEngine(const FarmSettings& settings) : settings_(settings) {}

  std::string submit(const FarmJob& job) override {
    std::string id = fmt::format("{}.{}", job.name, settings_.round);
    if (settings_.dryRun) {
      for (const auto& task : job.tasks) fmt::print("{}\n", shellLine(task));
      return id;
    }
    const bool mayStart = job.after.empty() || job.evenAfterFailure || endedWell_.at(job.after);
    endedWell_[id] = mayStart && run(job, id);
    return id;
  }

 private:
  bool run(const FarmJob& job, const std::string& id) const {
    const std::size_t atOnce = static_cast<std::size_t>(std::max(1, settings_.atOnce));
    Crew crew;
    for (std::size_t n = 0; n < job.tasks.size() && !interruptionRequested(); ++n) {
      while (crew.size() >= atOnce) crew.waitForOne();
      const std::string number = job.tasks.size() > 1 ? fmt::format(".{}", n) : "";
      crew.add(start(job.tasks[n], settings_.folder / fmt::format("{}{}.log", id, number)));
    }
    while (crew.size() > 0) crew.waitForOne();
    return crew.allWell() && !interruptionRequested();
  }

  FarmSettings settings_;
  std::map<std::string, bool> endedWell_;  ///< by job
};

}  // namespace

std::unique_ptr<FarmEngine> localEngine(const FarmSettings& settings) {
  return std::make_unique<LocalEngine>(settings);
}

}  // namespace brisance
