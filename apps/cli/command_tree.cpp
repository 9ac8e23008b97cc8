#include "command_tree.h"

#include <CLI/CLI.hpp>
#include <map>

#include "base/check.h"

namespace brisance {
namespace {

/// Words of "{curvature,spectral}", as a validator describes what it allows; none where it describes something else.
std::vector<std::string> wordsOf(const std::string& description) {
  const std::size_t open = description.find('{'), close = description.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  return CLI::detail::split(description.substr(open + 1, close - open - 1), ',');
}

std::vector<std::string> choicesOf(CLI::Option& option) {
  try {
    return wordsOf(option.get_validator(0)->get_description());
  } catch (const CLI::OptionNotFound&) {
    return {};
  }
}

ValueKind kindOf(const DescribedOption& option) {
  static const std::map<std::string, ValueKind> kinds{{"SCENE", ValueKind::scene}, {"MESH", ValueKind::meshOrScene},
                                                      {"RUN", ValueKind::folder},  {"PATH", ValueKind::file},
                                                      {"FILE", ValueKind::file},   {"OUT", ValueKind::file}};
  if (!option.choices.empty()) return ValueKind::words;
  const auto kind = kinds.find(option.placeholder);
  return kind == kinds.end() ? ValueKind::number : kind->second;
}

std::vector<std::string> namesOf(const CLI::Option& option) {
  std::vector<std::string> names;
  if (option.get_positional()) return {option.get_name(true)};
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

DescribedOption describe(CLI::Option& option) {
  DescribedOption told;
  told.names = namesOf(option);
  if (option.get_positional())
    told.placeholder = told.names.front();
  else if (option.get_items_expected_max() > 0)
    told.placeholder = option.get_option_text();
  told.what = option.get_description();
  told.choices = choicesOf(option);
  told.kind = kindOf(told);
  told.required = option.get_required();
  told.repeatable = told.takesValue() && option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  return told;
}

DescribedCommand describeCommand(const CLI::App& app) {
  DescribedCommand told{app.get_name(), app.get_description(), {}, {}};
  // CLI11 hands out validators, and with them what an option allows, only where they may be changed.
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? told.arguments : told.options).push_back(describe(const_cast<CLI::Option&>(*option)));
  return told;
}

}  // namespace

DescribedProgram describe(const CLI::App& app) {
  DescribedCommand top = describeCommand(app);
  DescribedProgram program{top.name, top.what, std::move(top.options), {}};
  for (const CLI::App* command : app.get_subcommands(nullptr)) program.commands.push_back(describeCommand(*command));
  return program;
}

const DescribedCommand& commandNamed(const DescribedProgram& program, const std::string& name) {
  std::string known;
  for (const DescribedCommand& command : program.commands) {
    if (command.name == name) return command;
    known += (known.empty() ? "" : ", ") + command.name;
  }
  throw InputError(fmt::format("brisance: {}: unknown command; must be one of {}", name, known));
}

std::string joined(const std::vector<std::string>& words, char between) {
  std::string text;
  for (const std::string& word : words) text.append(text.empty() ? 0 : 1, between).append(word);
  return text;
}

std::string usageOf(const DescribedCommand& command) {
  std::string usage = command.name;
  for (const DescribedOption& argument : command.arguments)
    usage += argument.required ? " " + argument.placeholder : fmt::format(" [{}]", argument.placeholder);
  for (const DescribedOption& option : command.options)
    if (option.required) usage += fmt::format(" {} {}", option.names.front(), option.placeholder);
  return usage + " [OPTION]...";
}

}  // namespace brisance
