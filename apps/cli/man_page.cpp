// Pages for `man`, in the macros of man(7).
#include <algorithm>
#include <sstream>

#include "base/check.h"
#include "command_notes.h"
#include "command_pages.h"

namespace brisance {
namespace {

/// Text that roff takes as it is: hyphens stay what they are, and nothing looks like a request.
std::string plain(const std::string& text) {
  std::string roff;
  for (const char letter : text) {
    if (letter == '\\')
      roff += "\\e";
    else if (letter == '-')
      roff += "\\-";
    else if (letter == '\'' || letter == '`')
      roff += letter == '`' ? "\\(ga" : "\\(aq";
    else
      roff += letter;
  }
  return roff.starts_with('.') ? fmt::format("\\&{}", roff) : roff;
}

std::string bold(const std::string& text) { return fmt::format("\\fB{}\\fR", plain(text)); }
std::string italic(const std::string& text) { return fmt::format("\\fI{}\\fR", plain(text)); }

std::string optional(const std::string& text) { return fmt::format("[{}]", italic(text)); }

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) { return std::toupper(letter); });
  return text;
}

std::string head(const std::string& page, const std::string& what) {
  return fmt::format(
      ".\\\" Generated from the definitions of the commands.\n"
      ".TH {} 1 {} \"brisance {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n",
      upper(plain(page)), BRISANCE_DATE, BRISANCE_VERSION, plain(page), plain(what));
}

/// Lines of at most 80 characters, broken at spaces; a word that begins with a point must not look like a request.
std::string wrapped(const std::string& line) {
  constexpr std::size_t widest = 80;
  std::istringstream words(line);
  std::string text, word;
  std::size_t width = 0;
  while (words >> word) {
    const bool breaks = width > 0 && width + 1 + word.size() > widest;
    text.append(breaks ? "\n" : width > 0 ? " " : "");
    if (breaks && word.front() == '.') text.append("\\&");
    text.append(word);
    width = breaks ? word.size() : width + 1 + word.size();
  }
  return text;
}

std::string tagged(const std::string& tag, const std::string& text) { return fmt::format(".TP\n{}\n{}\n", tag, text); }

std::string noted(const std::string& heading, const std::vector<Note>& notes) {
  std::string page = fmt::format(".SH {}\n", heading);
  for (const Note& note : notes) page += tagged(bold(note.name), wrapped(plain(note.what) + "."));
  return page;
}

std::string tagOf(const DescribedOption& option) {
  std::string tag;
  for (const std::string& name : option.names) tag.append(tag.empty() ? "" : ", ").append(bold(name));
  return option.takesValue() ? fmt::format("{} {}", tag, italic(option.placeholder)) : tag;
}

std::string textOf(const DescribedOption& option) {
  std::string text = wrapped(plain(option.what) + ".");
  if (!option.choices.empty()) {
    std::string choices = "One of";
    for (std::size_t n = 0; n < option.choices.size(); ++n)
      choices.append(n ? ", " : " ").append(bold(option.choices[n]));
    text.append("\n").append(wrapped(choices + "."));
  }
  if (option.required) text += "\nMust be given.";
  if (option.repeatable && option.what.find("repeat") == std::string::npos) text += "\nMay be repeated.";
  return text;
}

std::string optionsPart(const std::vector<DescribedOption>& options) {
  std::string page = ".SH OPTIONS\n";
  for (const DescribedOption& option : options) page += tagged(tagOf(option), textOf(option));
  return page;
}

std::string argumentsPart(const std::vector<DescribedOption>& arguments) {
  std::string page;
  for (const DescribedOption& argument : arguments) page += tagged(italic(argument.placeholder), textOf(argument));
  return page;
}

std::string synopsis(const DescribedCommand& command) {
  std::string page = ".SH SYNOPSIS\n" + bold("brisance " + command.name);
  for (const DescribedOption& argument : command.arguments)
    page += fmt::format(" {}", argument.required ? italic(argument.placeholder) : optional(argument.placeholder));
  for (const DescribedOption& option : command.options)
    if (option.required) page += fmt::format(" {} {}", bold(option.names.front()), italic(option.placeholder));
  return fmt::format("{} {}...\n", page, optional("OPTION"));
}

std::string examplesPart(const std::vector<Note>& examples) {
  std::string page = ".SH EXAMPLES\n";
  for (const Note& example : examples)
    page += tagged(plain(example.what) + ":", ".nf\n" + bold(example.name) + "\n.fi");
  return page;
}

std::string seeAlso(const std::vector<std::string>& pages) {
  std::string page = ".SH SEE ALSO\n";
  for (const std::string& name : pages) page += ".BR " + plain(name) + " (1)" + (name == pages.back() ? "\n" : " ,\n");
  return page;
}

std::string commandsPart(const DescribedProgram& program) {
  std::string page = ".SH COMMANDS\n";
  for (const DescribedCommand& command : program.commands)
    page += tagged(bold(command.name),
                   plain(command.what) + ".\nSee\n.BR " + plain(program.name + "-" + command.name) + " (1).");
  return page;
}

}  // namespace

std::string manPage(const DescribedProgram& program) {
  std::vector<std::string> pages;
  for (const DescribedCommand& command : program.commands) pages.push_back(program.name + "-" + command.name);
  return head(program.name, "films of exploding, shattering scenes") + ".SH SYNOPSIS\n" + bold(program.name) + " " +
         italic("COMMAND") + " [" + italic("OPTION") + "]...\n.SH DESCRIPTION\n" + plain(program.what) +
         "\nA charge of fuel burns in a box of gas. Gas that rushes past bodies, broken\n"
         "into pieces before time starts, pushes and turns each piece.\n"
         "Pictures are traced from glow, smoke and pieces.\n" +
         commandsPart(program) + optionsPart(program.options) + noted("EXIT STATUS", exitCodeNotes()) +
         noted("ENVIRONMENT", environmentNotes()) + noted("FILES", fileNotes()) + examplesPart(examplesOf("run")) +
         seeAlso(pages);
}

std::string manPage(const DescribedProgram& program, const DescribedCommand& command) {
  std::string page = head(program.name + "-" + command.name, command.what) + synopsis(command) + ".SH DESCRIPTION\n" +
                     argumentsPart(command.arguments) + optionsPart(command.options) +
                     noted("EXIT STATUS", exitCodeNotes()) + noted("FILES", fileNotes());
  const std::vector<Note> examples = examplesOf(command.name);
  if (!examples.empty()) page += examplesPart(examples);
  return page + seeAlso({program.name});
}

}  // namespace brisance
