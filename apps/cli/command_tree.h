// The commands as they were defined, in plain values: what pages and completions are made of.
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's
class App;
}

namespace brisance {

/// What may stand where a value is typed.
enum class ValueKind { number, words, scene, meshOrScene, folder, file };

struct DescribedOption {
  std::vector<std::string> names;    ///< "-o", "--output"; of a positional one, like "RUN"
  std::string placeholder;           ///< of its value, like "WxH"; empty: it takes none
  std::string what;                  ///< one line
  std::vector<std::string> choices;  ///< of ValueKind::words
  ValueKind kind = ValueKind::number;
  bool required = false;
  bool repeatable = false;

  bool takesValue() const { return !placeholder.empty(); }
};

struct DescribedCommand {
  std::string name, what;
  std::vector<DescribedOption> arguments;  ///< in the order in which they are typed
  std::vector<DescribedOption> options;
};

struct DescribedProgram {
  std::string name, what;
  std::vector<DescribedOption> options;
  std::vector<DescribedCommand> commands;
};

DescribedProgram describe(const CLI::App& app);

/// The command of this name. Throws InputError listing those that there are.
const DescribedCommand& commandNamed(const DescribedProgram& program, const std::string& name);

/// "a|b|c".
std::string joined(const std::vector<std::string>& words, char between);

/// "simulate SCENE -o RUN [OPTION]...": what must be typed, and that more may be.
std::string usageOf(const DescribedCommand& command);

}  // namespace brisance
