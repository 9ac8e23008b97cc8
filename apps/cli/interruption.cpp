#include "interruption.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>

#include "shell_words.h"

namespace brisance {

namespace {

constexpr int signalExitBase = 128;  // a shell's exit code for a process that a signal ended

volatile sig_atomic_t received = 0;

/// Only what is safe inside a signal handler.
void onSignal(int number) {
  if (received != 0) _exit(signalExitBase + number);
  received = number;
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
  std::vector<std::string> words = arguments;
  std::erase(words, "--overwrite");
  const bool isThere = option.empty() || std::find(words.begin(), words.end(), option) != words.end();
  if (!isThere) words.push_back(option);
  return shellLine(words);
}

}  // namespace brisance
