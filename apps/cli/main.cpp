// brisance: one scene file in, a film out. Reads the command line, calls the command, turns trouble into one line.
#include <cerrno>
#include <cstdio>
#include <map>
#include <new>
#include <system_error>

#include "base/check.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "commands.h"
#include "interruption.h"

namespace brisance {
namespace {

int code(ExitCode exitCode) { return static_cast<int>(exitCode); }

int call(const Options& options) {
  static const std::map<std::string, int (*)(const Options&)> commands{
      {"run", runCommand},           {"simulate", simulateCommand},
      {"render", renderCommand},     {"encode", encodeCommand},
      {"check", checkCommand},       {"info", infoCommand},
      {"verify", verifyCommand},     {"reference", referenceCommand},
      {"fracture", fractureCommand}, {"export", exportCommand},
      {"view", viewCommand}};
  const ThreadLimit limit(options.threads);
  return commands.at(options.command)(options);
}

bool meansNoRoom(const std::error_code& trouble) {
  return trouble == std::errc::no_space_on_device || trouble == std::errc::permission_denied ||
         trouble == std::errc::read_only_file_system || trouble == std::errc::not_enough_memory;
}

int sayAndReturn(const std::string& line, int exitCode) {
  std::fputs((line + "\n").c_str(), stderr);
  return exitCode;
}

/// One line for whatever is thrown, and the exit code that belongs to it. Called inside a handler.
int explainTrouble() {
  try {
    throw;
  } catch (const Error& trouble) {
    return sayAndReturn(trouble.what(), code(trouble.code));
  } catch (const std::bad_alloc&) {
    return sayAndReturn(
        "brisance: not enough memory; make the grids of the scene smaller (brisance check tells the need)",
        code(ExitCode::noRoom));
  } catch (const std::system_error& trouble) {
    return sayAndReturn(fmt::format("brisance: {}", trouble.what()),
                        code(meansNoRoom(trouble.code()) ? ExitCode::noRoom : ExitCode::failed));
  } catch (const std::exception& trouble) {
    return sayAndReturn(fmt::format("brisance: {}", trouble.what()), code(ExitCode::failed));
  }
}

int sayHowToContinue(const Options& options) {
  const std::string command = commandThatContinues(options.arguments, continuingOption(options.command));
  return sayAndReturn("brisance: interrupted; continue with: " + command, interruptionExitCode());
}

int program(int count, const char* const* arguments) {
  keepFreedMemory();
  CommandLine line;
  try {
    line = parseCommandLine(count, arguments);
    if (line.exitCode) return *line.exitCode;
    listenForInterruption();
    const int exitCode = call(line.options);
    return interruptionRequested() ? sayHowToContinue(line.options) : exitCode;
  } catch (...) {
    // Ctrl-C reaches the encoder too: what it then complains of is no trouble of its own.
    return interruptionRequested() ? sayHowToContinue(line.options) : explainTrouble();
  }
}

}  // namespace
}  // namespace brisance

int main(int count, char** arguments) { return brisance::program(count, arguments); }
