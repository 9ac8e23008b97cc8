// Three kinds of trouble: the user's (an Error with its exit code), the numbers' (returned in reports), and ours
// (CHECK).
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace brisance {

/// What the program's exit code promises to scripts.
enum class ExitCode {
  done = 0,
  failed = 1,        ///< failed while working: a missing tool, a lock held by a living run
  badScene = 2,      ///< the command line or the scene is wrong
  badInput = 3,      ///< an input file is damaged or not accepted
  noRoom = 4,        ///< disk full, directory not writable, not enough memory
  unstable = 5,      ///< the simulation left its stable range
  interrupted = 130  ///< Ctrl-C; SIGTERM is 143
};

/// Trouble that the user can act on: one line that names the file, the place and what would be right.
class Error : public std::runtime_error {
 public:
  Error(ExitCode exitCode, const std::string& line) : std::runtime_error(line), code(exitCode) {}
  ExitCode code;
};

/// The user's mistake in a command line or scene (exit code 2).
class InputError : public Error {
 public:
  explicit InputError(const std::string& line) : Error(ExitCode::badScene, line) {}
};

/// A file that lies or is damaged (exit code 3).
class DamagedFile : public Error {
 public:
  explicit DamagedFile(const std::string& line) : Error(ExitCode::badInput, line) {}
};

[[noreturn]] inline void checkFailed(const char* condition, const char* file, int line, const std::string& values) {
  throw std::logic_error(fmt::format("{}:{}: broken promise: {} {}", file, line, condition, values));
}

}  // namespace brisance

/// Our own bug stops here and prints the values: CHECK(i < n, "i {} n {}", i, n).
#define CHECK(condition, ...) \
  ((condition) ? void() : ::brisance::checkFailed(#condition, __FILE__, __LINE__, ::fmt::format("" __VA_ARGS__)))
