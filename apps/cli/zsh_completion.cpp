#include <fmt/format.h>

#include "completions.h"

namespace brisance {
namespace {

/// Text between single quotes of a specification of _arguments: its own signs are escaped.
std::string quoted(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '\'')
      escaped += "'\\''";
    else if (letter == '[' || letter == ']' || letter == ':' || letter == '\\')
      escaped.append(1, '\\').append(1, letter);
    else
      escaped += letter;
  }
  return escaped;
}

std::string actionOf(const DescribedOption& option) {
  switch (option.kind) {
    case ValueKind::number:
      return " ";
    case ValueKind::words:
      return fmt::format("({})", joined(option.choices, ' '));
    case ValueKind::scene:
      return "_files -g \"*.toml\"";
    case ValueKind::meshOrScene:
      return "_files -g \"*.(toml|obj|ply|stl|glb|gltf)\"";
    case ValueKind::folder:
      return "_files -/";
    case ValueKind::file:
      return "_files";
  }
  return " ";
}

std::string specifications(const DescribedOption& option) {
  std::string lines;
  for (const std::string& name : option.names) {
    const char* joint = option.takesValue() && name.starts_with("--") ? "=" : "";
    lines += fmt::format(" \\\n        '{}{}{}[{}]{}'", option.repeatable ? "*" : "", name, joint, quoted(option.what),
                         option.takesValue() ? fmt::format(":{}:{}", option.placeholder, actionOf(option)) : "");
  }
  return lines;
}

std::string commandCase(const DescribedCommand& command) {
  std::string text = fmt::format("    {})\n      _arguments", command.name);
  for (const DescribedOption& option : command.options) text += specifications(option);
  for (const DescribedOption& argument : command.arguments)
    text += fmt::format(" \\\n        ':{}:{}'", argument.placeholder, actionOf(argument));
  return text + "\n      ;;\n";
}

}  // namespace

std::string zshCompletion(const DescribedProgram& program) {
  std::string names, cases, options;
  for (const DescribedCommand& command : program.commands) {
    names += fmt::format("    '{}:{}'\n", command.name, quoted(command.what));
    cases += commandCase(command);
  }
  for (const DescribedOption& option : program.options) options += specifications(option);
  return fmt::format(
      "#compdef brisance\n# Completion of brisance in zsh. Generated from the definitions of the commands.\n\n"
      "_brisance() {{\n  local context state state_descr line\n  typeset -A opt_args\n  local -a commands=(\n{}  )\n"
      "  _arguments -C{} \\\n        '1:command:->command' '*::rest:->rest'\n"
      "  [[ $state == command ]] && _describe command commands\n  [[ $state == rest ]] || return\n"
      "  case $line[1] in\n{}  esac\n}}\n\n_brisance \"$@\"\n",
      names, options, cases);
}

}  // namespace brisance
