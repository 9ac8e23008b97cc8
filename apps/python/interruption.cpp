#include "interruption.h"

namespace brisance::python {

namespace {
constexpr std::chrono::milliseconds patience{100};  // a thread that wants the lock may wait some for it
}

StopRequested Interruption::question() {
  return [this] { return asked(); };
}

/// Handlers run on the caller's thread alone, as Python wants it; what they raise waits there for raise().
bool Interruption::asked() {
  if (stopped_ || std::this_thread::get_id() != caller_) return stopped_;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < patience) return false;
  last_ = now;
  const pybind11::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) stopped_ = true;
  return stopped_;
}

void Interruption::raise() const {
  if (stopped_) throw pybind11::error_already_set();
}

}  // namespace brisance::python
