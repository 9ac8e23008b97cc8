// brisance: one scene file in, a film out. Reads the command line, calls the command, turns trouble into one line.
#include <cstdio>
#include <map>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/trouble.h"
#include "commands.h"
#include "interruption.h"

namespace brisance {
namespace {

int code(ExitCode exitCode) { return static_cast<int>(exitCode); }

int call(const Options& options) {
  static const std::map<std::string, int (*)(const Options&)> commands{
      {"run", runCommand},       {"simulate", simulateCommand},   {"render", renderCommand},
      {"encode", encodeCommand}, {"check", checkCommand},         {"info", infoCommand},
      {"verify", verifyCommand}, {"reference", referenceCommand}, {"fracture", fractureCommand},
      {"export", exportCommand}, {"view", viewCommand},           {"farm", farmCommand}};
  const ThreadLimit limit(options.threads);
  return commands.at(options.command)(options);
}

int sayAndReturn(const std::string& line, int exitCode) {
  std::fputs((line + "\n").c_str(), stderr);
  return exitCode;
}

/// Called inside a handler.
int explainTrouble() {
  const Trouble trouble = troubleAtHand();
  return sayAndReturn(trouble.line, code(trouble.code));
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
