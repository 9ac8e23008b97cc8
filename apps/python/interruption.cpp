#include "interruption.h"

namespace brisance::python {

namespace py = pybind11;

std::optional<py::error_already_set> waitFor(const std::function<bool(std::chrono::milliseconds)>& hasEnded,
                                             Cancellation& cancellation) {
  constexpr std::chrono::milliseconds patience{50};
  const auto endsMeanwhile = [&] {
    const py::gil_scoped_release others;
    return hasEnded(patience);
  };
  std::optional<py::error_already_set> raised;
  while (!endsMeanwhile()) {
    if (raised || PyErr_CheckSignals() == 0) continue;
    raised.emplace();
    cancellation.request();
  }
  return raised;
}

}  // namespace brisance::python
