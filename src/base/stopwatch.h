// Wall time.
#pragma once

#include <chrono>

namespace brisance {

class Stopwatch {
 public:
  /// Since it was made or last read by lap().
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  double lap() {
    const double passed = seconds();
    start_ = Clock::now();
    return passed;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace brisance
