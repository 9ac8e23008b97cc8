// brisance reference: pages about the scene file and the commands.
#include "scene/reference.h"

#include <cstdio>
#include <map>

#include "base/check.h"
#include "command_pages.h"
#include "commands.h"
#include "completions.h"

namespace brisance {
namespace {

std::string pageOfMan(const DescribedProgram& program, const std::string& command) {
  return command.empty() ? manPage(program) : manPage(program, commandNamed(program, command));
}

std::string pageOfCommands(const Options& options) {
  static const std::map<std::string, std::string (*)(const DescribedProgram&)> pages{
      {"commands", commandsDocument},
      {"completion-bash", bashCompletion},
      {"completion-zsh", zshCompletion},
      {"completion-fish", fishCompletion}};
  const DescribedProgram program = describedProgram();
  return options.page == "man" ? pageOfMan(program, options.pageOf) : pages.at(options.page)(program);
}

std::string pageOf(const Options& options) {
  if (!options.pageOf.empty() && options.page != "man")
    throw InputError(
        fmt::format("brisance: {}: only man has pages of single commands, not {}", options.pageOf, options.page));
  if (options.page == "schema") return sceneSchema();
  return options.page == "parameters" ? parametersDocument() : pageOfCommands(options);
}

}  // namespace

int referenceCommand(const Options& options) {
  fmt::print("{}", pageOf(options));
  return static_cast<int>(ExitCode::done);
}

}  // namespace brisance
