#include "base/vector_path.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <string_view>

namespace brisance {

namespace {
VectorPath widest() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return VectorPath::avx512;
  return __builtin_cpu_supports("avx2") ? VectorPath::avx2 : VectorPath::plain;
}

VectorPath fromEnvironment() {
  const char* text = std::getenv("BRISANCE_VECTOR");
  const std::string_view wish = text ? text : "";
  if (wish == "plain") return VectorPath::plain;
  if (wish == "avx2") return std::min(widest(), VectorPath::avx2);
  return widest();
}

std::atomic<VectorPath>& chosen() {
  static std::atomic<VectorPath> path{fromEnvironment()};
  return path;
}
}  // namespace

VectorPath vectorPath() { return chosen().load(std::memory_order_relaxed); }
void forceVectorPath(VectorPath path) { chosen() = std::min(path, widest()); }

}  // namespace brisance
