// Ctrl-C and SIGTERM: finish the work at hand, then leave; a second signal leaves at once.
#pragma once

#include <string>
#include <vector>

namespace brisance {

/// Listens from now on. The handlers stay for the life of the process.
void listenForInterruption();

/// True once the user wants to stop.
bool interruptionRequested();

/// 130 after Ctrl-C, 143 after SIGTERM; 0 when there was none.
int interruptionExitCode();

/// The command as typed, without --overwrite and with `option` (empty: none), quoted for a shell.
std::string commandThatContinues(const std::vector<std::string>& arguments, const std::string& option);

}  // namespace brisance
