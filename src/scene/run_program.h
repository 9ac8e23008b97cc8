// Other people's programs, run without a shell.
#pragma once

#include <string>
#include <vector>

namespace brisance {

/// For messages: what a program is called for, and the Debian package that it is in.
struct Errand {
  const char* name = "film";
  const char* package = "ffmpeg";
};

/// Runs arguments[0] with the rest as its arguments, waits, and returns what it wrote to standard output. Throws
/// Error(failed) in one line when it is not installed or ends with another code than 0, Error(noRoom) when it met a
/// full disk.
std::string runProgram(const std::vector<std::string>& arguments, const Errand& errand = {});

}  // namespace brisance
