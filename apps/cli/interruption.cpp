#include "interruption.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>

namespace brisance {

namespace {

constexpr int signalExitBase = 128;  // a shell's exit code for a process that a signal ended

volatile sig_atomic_t received = 0;

/// Only what is safe inside a signal handler.
void onSignal(int number) {
  if (received != 0) _exit(signalExitBase + number);
  received = number;
}

bool isPlainForAShell(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) ||
         std::string("-_./=,:@%+").find(letter) != std::string::npos;
}

std::string quoted(const std::string& word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), isPlainForAShell)) return word;
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

}  // namespace

void listenForInterruption() {
  struct sigaction action = {};
  action.sa_handler = onSignal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interruptionRequested() { return received != 0; }

int interruptionExitCode() { return received == 0 ? 0 : signalExitBase + received; }

std::string commandThatContinues(const std::vector<std::string>& arguments, const std::string& option) {
  std::vector<std::string> words;
  for (const std::string& argument : arguments)
    if (argument != "--overwrite") words.push_back(quoted(argument));
  const bool isThere = option.empty() || std::find(words.begin(), words.end(), option) != words.end();
  if (!isThere) words.push_back(option);
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    line += word;
  }
  return line;
}

}  // namespace brisance
