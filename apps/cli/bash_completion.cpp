#include <fmt/format.h>
#include "completions.h"

namespace brisance {
namespace {

/// The shell's function above the tables: what is asked for, and how it is offered.
constexpr const char* offering = R"sh(
# _brisance_offer KIND [WORD...]: what fits the word under the cursor.
_brisance_offer() {
  local kind=$1 pattern=''
  shift
  case $kind in
    words) mapfile -t COMPREPLY < <(compgen -W "$*" -- "$current") && return ;;
    number) return ;;
    scene) pattern='!*.toml' ;;
    meshOrScene) pattern='!*.@(toml|obj|ply|stl|glb|gltf)' ;;
    folder) mapfile -t COMPREPLY < <(compgen -d -- "$current") ;;
    file) mapfile -t COMPREPLY < <(compgen -f -- "$current") ;;
  esac
  if [[ -n $pattern ]]; then
    local extglob=$(shopt -p extglob)
    shopt -s extglob
    mapfile -t COMPREPLY < <(compgen -f -X "$pattern" -- "$current"; compgen -d -- "$current")
    $extglob
  fi
  compopt -o filenames 2>/dev/null || true
}

# The command is the first word that is no option; --option=value reaches us as three words.
_brisance() {
  local current=$2 previous=$3 command='' at
  COMPREPLY=()
  for ((at = 1; at < COMP_CWORD; ++at)); do
    [[ ${COMP_WORDS[at]} == -* ]] || { command=${COMP_WORDS[at]} && break; }
  done
  [[ $current == = ]] && current=''
  [[ $previous == = ]] && previous=${COMP_WORDS[COMP_CWORD - 2]}
  local offer=$(_brisance_value "$command" "$previous")
  if [[ -z $offer && $current == -* ]]; then
    offer="words $(_brisance_options "$command")"
  elif [[ -z $offer ]]; then
    offer=$(_brisance_argument "$command")
  fi
  [[ -z $offer ]] || _brisance_offer $offer
}

complete -F _brisance brisance
)sh";

const char* wordOf(ValueKind kind) {
  constexpr const char* words[] = {"number", "words", "scene", "meshOrScene", "folder", "file"};
  return words[static_cast<int>(kind)];
}

std::string offerOf(const DescribedOption& option) {
  std::vector<std::string> offer{wordOf(option.kind)};
  offer.insert(offer.end(), option.choices.begin(), option.choices.end());
  return joined(offer, ' ');
}

std::string namesOf(const std::vector<DescribedOption>& options) {
  std::vector<std::string> names;
  for (const DescribedOption& option : options) names.insert(names.end(), option.names.begin(), option.names.end());
  return joined(names, ' ');
}

/// A shell's function NAME that prints by its first word (and its second) what `cases` say.
std::string table(const std::string& name, const std::string& on, const std::string& cases) {
  return fmt::format("\n{}() {{\n  case {} in\n{}  esac\n}}\n", name, on, cases);
}

std::string line(const std::string& pattern, const std::string& text) {
  return fmt::format("    {}) echo '{}' ;;\n", pattern, text);
}

std::string optionLines(const DescribedProgram& program) {
  std::string lines = line("''", namesOf(program.options));
  for (const DescribedCommand& command : program.commands) lines += line(command.name, namesOf(command.options));
  return lines;
}

/// Any of the option's names behind the command's.
std::string patternOf(const DescribedCommand& command, const DescribedOption& option) {
  std::vector<std::string> patterns;
  for (const std::string& name : option.names) patterns.push_back(fmt::format("{}:{}", command.name, name));
  return joined(patterns, '|');
}

std::string valueLines(const DescribedProgram& program) {
  std::string lines;
  for (const DescribedCommand& command : program.commands)
    for (const DescribedOption& option : command.options)
      if (option.takesValue()) lines += line(patternOf(command, option), offerOf(option));
  return lines;
}

std::string argumentLines(const DescribedProgram& program) {
  std::vector<std::string> offer{"words"};
  for (const DescribedCommand& command : program.commands) offer.push_back(command.name);
  std::string lines = line("''", joined(offer, ' '));
  for (const DescribedCommand& command : program.commands)
    if (!command.arguments.empty()) lines += line(command.name, offerOf(command.arguments.front()));
  return lines;
}

}  // namespace

std::string bashCompletion(const DescribedProgram& program) {
  return "# Completion of brisance in bash. Generated from the definitions of the commands.\n" +
         table("_brisance_options", "$1", optionLines(program)) +
         table("_brisance_value", "$1:$2", valueLines(program)) +
         table("_brisance_argument", "$1", argumentLines(program)) + offering;
}

}  // namespace brisance
