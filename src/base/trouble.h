// What was thrown, as one line for people and an exit code for scripts.
#pragma once

#include "base/check.h"

namespace brisance {

struct Trouble {
  ExitCode code = ExitCode::failed;
  std::string line;
};

/// Of the exception at hand: to be called inside a handler.
Trouble troubleAtHand();

}  // namespace brisance
