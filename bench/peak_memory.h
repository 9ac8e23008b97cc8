// How much memory a piece of work took at its height.
#pragma once

#include <malloc.h>

#include <fstream>
#include <string>

namespace brisance {

/// Counts from its making. Linux only: the kernel's high-water mark of the process, set back to what is in use.
class PeakMemory {
 public:
  PeakMemory() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";
    before_ = statusMegabytes("VmRSS:");
  }
  double grownBy() const { return statusMegabytes("VmHWM:") - before_; }  ///< [MB]

 private:
  static double statusMegabytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    std::string word;
    double kilobytes = 0;
    while (status >> word)
      if (word == key) status >> kilobytes;
    return kilobytes / 1024;
  }
  double before_ = 0;
};

}  // namespace brisance
