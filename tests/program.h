// The real program as a test sees it: started, watched, interrupted; and places to run it in.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "scratch_directory.h"

namespace brisance::test {

namespace fs = std::filesystem;

inline std::string textOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void writeText(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
}

/// How a program ended and what it said.
struct Outcome {
  int exitCode = 0;  ///< as a shell tells it: 128 + n after signal n
  std::string out, err;
};

/// What a child is started with beside its arguments.
struct StartOptions {
  std::string binary = BRISANCE_BINARY;
  std::vector<std::pair<std::string, std::string>> environment;
  std::function<void()> beforeStart;  ///< in the child
};

/// A running brisance.
class Program {
 public:
  explicit Program(const std::vector<std::string>& arguments, const StartOptions& options = {}) {
    child_ = fork();
    if (child_ < 0) throw std::runtime_error("no process");
    if (child_ == 0) become(arguments, options);
  }
  ~Program() {
    if (child_ > 0) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void send(int signal) { kill(child_, signal); }
  bool isAlive() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
  }

  Outcome wait() {
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, textOf(said_ / "out"), textOf(said_ / "err")};
  }

 private:
  [[noreturn]] void become(const std::vector<std::string>& arguments, const StartOptions& options) {
    redirect(said_ / "out", STDOUT_FILENO);
    redirect(said_ / "err", STDERR_FILENO);
    for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
    if (options.beforeStart) options.beforeStart();
    std::vector<std::string> words{options.binary};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execv(options.binary.c_str(), pointers.data());
    _exit(127);
  }
  static void redirect(const fs::path& file, int descriptor) {
    const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(opened, descriptor);
    close(opened);
  }

  ScratchDirectory said_;
  pid_t child_ = -1;
};

inline Outcome runProgram(const std::vector<std::string>& arguments, const StartOptions& options = {}) {
  return Program(arguments, options).wait();
}

/// Waits until `condition` holds; false after `seconds`.
inline bool waitUntil(const std::function<bool()>& condition, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    usleep(2000);
  }
  return true;
}

/// Files under `directory` that a killed or failing program may leave only by mistake.
inline std::vector<std::string> temporariesIn(const fs::path& directory) {
  std::vector<std::string> found;
  if (!fs::exists(directory)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.path().filename().string().starts_with(".tmp.")) found.push_back(entry.path().string());
  return found;
}

/// A few grams of fuel behind a pane of six pieces: fractions of a second a frame.
inline std::string smallSceneText(int frames) {
  std::ostringstream text;
  text << R"(
[scene]
seed = 7
frames = )"
       << frames << R"(
checkpoint_every = 2

[gas]
cells = [16, 16, 16]
size = [1.0, 1.0, 1.0]
start_velocity = 0.001
buoyancy = 0.01

[explosion]
heating = 75000
deposit_radius = 0.08
charges = [{ position = [0.5, 0.5, 0.4], radius = 0.1, particles = 200, ignited = 100, emission_rate = 600, emission_time = 0.1 }]

[rigid.push]
force_constant = 300

[[bodies]]
name = "pane"
shape = { type = "pane", width = 0.3, height = 0.4, thickness = 0.005, points = 40 }
position = [0.5, 0.5, 0.65]
fracture = { pieces = 6 }

[camera]
position = [0.5, 0.6, 3.0]
look_at = [0.5, 0.5, 0.5]

[render]
width = 32
height = 24
samples = 1
volume = { cells = [24, 24, 24] }
)";
  return text.str();
}

}  // namespace brisance::test
