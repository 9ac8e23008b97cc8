#include <fmt/format.h>

#include "completions.h"

namespace brisance {
namespace {

std::string quoted(const std::string& text) {
  std::string escaped = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') escaped += '\\';
    escaped += letter;
  }
  return escaped + "'";
}

/// What may stand where a value is typed, as further words of `complete`.
std::string valueOf(const DescribedOption& option) {
  switch (option.kind) {
    case ValueKind::number:
      return " -x";
    case ValueKind::words:
      return fmt::format(" -xa '{}'", joined(option.choices, ' '));
    case ValueKind::scene:
      return " -xa '(__fish_complete_suffix .toml)'";
    case ValueKind::meshOrScene:
      return " -xa '(__fish_complete_suffix .toml .obj .ply .stl .glb .gltf)'";
    case ValueKind::folder:
      return " -xa '(__fish_complete_directories)'";
    case ValueKind::file:
      return " -rF";
  }
  return "";
}

std::string optionLine(const std::string& when, const DescribedOption& option) {
  std::string line = "complete -c brisance -n " + when;
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2)) : fmt::format(" -s {}", name.substr(1));
  return line + (option.takesValue() ? valueOf(option) : "") + " -d " + quoted(option.what) + "\n";
}

}  // namespace

std::string fishCompletion(const DescribedProgram& program) {
  std::string text =
      "# Completion of brisance in fish. Generated from the definitions of the commands.\ncomplete -c brisance -f\n";
  for (const DescribedOption& option : program.options) text += optionLine("__fish_use_subcommand", option);
  for (const DescribedCommand& command : program.commands) {
    const std::string when = quoted("__fish_seen_subcommand_from " + command.name);
    text +=
        fmt::format("complete -c brisance -n __fish_use_subcommand -a {} -d {}\n", command.name, quoted(command.what));
    for (const DescribedOption& argument : command.arguments)
      text += fmt::format("complete -c brisance -n {}{}\n", when, valueOf(argument));
    for (const DescribedOption& option : command.options) text += optionLine(when, option);
  }
  return text;
}

}  // namespace brisance
