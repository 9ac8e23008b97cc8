// Loops over threads whose results do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace brisance {

/// Calls body(begin, end) on pieces of [begin, end) of at least `grain`; pieces run on any thread in any order.
void parallelFor(std::int64_t begin, std::int64_t end, std::int64_t grain,
                 const std::function<void(std::int64_t, std::int64_t)>& body);

/// Sum of block(first, last) over fixed blocks of `blockSize`, added in order: the same bits for any number of threads.
double parallelSum(std::int64_t count, std::int64_t blockSize,
                   const std::function<double(std::int64_t, std::int64_t)>& block);
/// Likewise the maximum; 0 for an empty range.
double parallelMax(std::int64_t count, std::int64_t blockSize,
                   const std::function<double(std::int64_t, std::int64_t)>& block);

/// Holds the number of threads to `threads` (0: all cores) while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};
/// Threads that a parallel loop may use now.
int threadCount();

}  // namespace brisance
