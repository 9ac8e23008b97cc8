#include "scene/run_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/check.h"

namespace brisance {
namespace {

constexpr int missingTool = 127;  // what shells, and the child below, say for a program that is not there

/// What a program said and how it ended.
struct Finished {
  int status = 0;      ///< exit code, or 128 + signal
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
};

/// The ends of a pipe, closed when no longer needed.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_, O_CLOEXEC) != 0)
      throw Error(ExitCode::failed, fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  }
  ~Pipe() { close(0), close(1); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int end(int which) const { return ends_[which]; }
  void close(int which) {
    if (ends_[which] >= 0) ::close(ends_[which]);
    ends_[which] = -1;
  }

 private:
  int ends_[2] = {-1, -1};
};

/// Everything until the writer closes.
std::string drain(int descriptor) {
  std::string text;
  char buffer[4096];
  for (;;) {
    const ssize_t count = read(descriptor, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(count));
  }
}

/// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void becomeProgram(char* const* arguments, int output, int errors) {
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  execvp(arguments[0], arguments);
  _exit(missingTool);
}

int waitFor(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  constexpr int signalBase = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : signalBase + WTERMSIG(status);
}

/// Runs a program without a shell: no file name can be taken for a command. The errors go to a file that is read
/// afterwards, so that a talkative program cannot block on a pipe nobody empties.
Finished spawn(std::vector<std::string> arguments) {
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  Pipe output;
  const int errors = memfd_create("errors", MFD_CLOEXEC);
  if (errors < 0) throw Error(ExitCode::failed, fmt::format("cannot start {}: {}", arguments[0], std::strerror(errno)));
  const pid_t child = fork();
  if (child == 0) becomeProgram(pointers.data(), output.end(1), errors);
  output.close(1);
  Finished finished;
  if (child < 0) finished.status = errno;
  if (child > 0) finished.output = drain(output.end(0)), finished.status = waitFor(child);
  lseek(errors, 0, SEEK_SET);
  finished.errors = drain(errors);
  close(errors);
  return finished;
}

/// The last line that a program said, which is where it names its trouble.
std::string lastLine(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
  const std::size_t line = text.find_last_of("\r\n");
  return line == std::string::npos ? text : text.substr(line + 1);
}

}  // namespace

std::string runProgram(const std::vector<std::string>& arguments, const Errand& errand) {
  const Finished finished = spawn(arguments);
  const std::string& program = arguments[0];
  if (finished.status == missingTool)
    throw Error(ExitCode::failed, fmt::format("{}: there is no program {}; install {} (apt-get install {})",
                                              errand.name, program, errand.package, errand.package));
  if (finished.errors.find(std::strerror(ENOSPC)) != std::string::npos)
    throw Error(ExitCode::noRoom,
                fmt::format("{}: {}: the disk is full; make room and try again", errand.name, program));
  if (finished.status != 0)
    throw Error(ExitCode::failed, fmt::format("{}: {} failed with code {}: {}", errand.name, program, finished.status,
                                              lastLine(finished.errors)));
  return finished.output;
}

}  // namespace brisance
