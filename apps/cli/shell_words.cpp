#include "shell_words.h"

#include <algorithm>
#include <cctype>

namespace brisance {
namespace {

bool isPlainForAShell(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) ||
         std::string("-_./=,:@%+").find(letter) != std::string::npos;
}

}  // namespace

std::string shellQuoted(const std::string& word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), isPlainForAShell)) return word;
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

std::string shellLine(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    line += shellQuoted(word);
  }
  return line;
}

}  // namespace brisance
