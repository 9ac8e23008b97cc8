// Ctrl-C while the module works: Python's own handlers run, and what they raise ends the work.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "base/progress.h"

namespace brisance::python {

/// Of one call into the module. Made on the thread that calls, which holds the interpreter's lock then.
class Interruption {
 public:
  Interruption() : caller_(std::this_thread::get_id()) {}
  /// For the work, without the lock, from any thread; lives no longer than this.
  StopRequested question();
  /// Raises what a handler raised, if one did. With the lock.
  void raise() const;

 private:
  bool asked();
  std::thread::id caller_;
  std::chrono::steady_clock::time_point last_{};
  std::atomic<bool> stopped_ = false;
};

}  // namespace brisance::python
