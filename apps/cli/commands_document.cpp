// The commands in Markdown, for docs/commands.md.
#include "base/check.h"
#include "command_notes.h"
#include "command_pages.h"

namespace brisance {
namespace {

/// Text in a cell of a table.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char letter : text) escaped += letter == '|' ? std::string("\\|") : std::string(1, letter);
  return escaped;
}

std::string nameCell(const DescribedOption& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += fmt::format("{}`{}{}`", names.empty() ? "" : ", ", name,
                         option.takesValue() && name != option.placeholder ? " " + option.placeholder : "");
  return names;
}

std::string textCell(const DescribedOption& option) {
  std::string text = cell(option.what);
  if (!option.choices.empty()) {
    text += "; one of";
    for (std::size_t n = 0; n < option.choices.size(); ++n)
      text += fmt::format("{}`{}`", n ? ", " : " ", option.choices[n]);
  }
  if (option.required) text += "; must be given";
  if (option.repeatable && text.find("repeat") == std::string::npos) text += "; may be repeated";
  return text;
}

std::string rows(const std::vector<DescribedOption>& options) {
  std::string text;
  for (const DescribedOption& option : options)
    text += fmt::format("| {} | {} |\n", nameCell(option), textCell(option));
  return text;
}

std::string sentence(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text + ".";
}

std::string section(const DescribedProgram& program, const DescribedCommand& command) {
  std::string text = fmt::format("\n## {} {}\n\n{}\n\n```\n{} {}\n```\n\n| | |\n|---|---|\n", program.name,
                                 command.name, sentence(command.what), program.name, usageOf(command));
  text += rows(command.arguments) + rows(command.options);
  const std::vector<Note> examples = examplesOf(command.name);
  if (examples.empty()) return text;
  text += "\n```\n";
  for (const Note& example : examples) text += fmt::format("# {}\n{}\n", example.what, example.name);
  return text + "```\n";
}

std::string noteRows(const std::vector<Note>& notes) {
  std::string text;
  for (const Note& note : notes) text += fmt::format("| `{}` | {} |\n", note.name, cell(note.what));
  return text;
}

}  // namespace

std::string commandsDocument(const DescribedProgram& program) {
  std::string text = fmt::format(
      "# Commands\n\nGenerated from the definitions that the program reads its command line by; a test compares it "
      "with "
      "them.\nThe same is in `man brisance` and `brisance COMMAND --help`.\n\n{}\n",
      program.what);
  for (const DescribedCommand& command : program.commands) text += section(program, command);
  return text + "\n## Exit codes\n\n| exit code | means |\n|---|---|\n" + noteRows(exitCodeNotes()) +
         "\n## Environment\n\n| | |\n|---|---|\n" + noteRows(environmentNotes()) + "\n## Files\n\n| | |\n|---|---|\n" +
         noteRows(fileNotes());
}

}  // namespace brisance
