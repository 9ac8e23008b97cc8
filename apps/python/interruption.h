// Ctrl-C while the module works: Python's own handlers run, and what they raise cuts the work short.
#pragma once

#include <pybind11/pybind11.h>

#include <future>
#include <optional>
#include <type_traits>

#include "base/cancellation.h"
#include "base/progress.h"

namespace brisance::python {

/// Twenty times a second, until the work has ended: gives the interpreter's lock to others, and lets handlers of
/// signals run, which Python wants on its main thread. Once one raises, asks the work to end. Returns what was raised.
std::optional<pybind11::error_already_set> waitFor(const std::function<bool(std::chrono::milliseconds)>& hasEnded,
                                                   Cancellation& cancellation);

/// Does `work` on a thread of its own, without the interpreter's lock. Called with it. Raises what a handler raised,
/// also where the work came to its end nonetheless.
template <class Work>
std::invoke_result_t<const Work&> interruptibly(const Work& work) {
  Cancellation cancellation;
  auto result = std::async(std::launch::async, [&] {
    const CancellableWork cancellable(&cancellation);
    return work();
  });
  const auto raised = waitFor(
      [&](std::chrono::milliseconds time) { return result.wait_for(time) == std::future_status::ready; }, cancellation);
  if (raised) throw *raised;
  return result.get();
}

}  // namespace brisance::python
