#include "base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "base/cancellation.h"

namespace brisance {

void parallelFor(std::int64_t begin, std::int64_t end, std::int64_t grain,
                 const std::function<void(std::int64_t, std::int64_t)>& body) {
  if (begin >= end) return;
  throwIfCancelled();
  if (end - begin <= grain) return body(begin, end);
  const Cancellation* cancellation = cancellationAtHand();
  // A loop inside another is not ended, as if it were done, by an exception in the other's pieces.
  tbb::task_group_context own(tbb::task_group_context::isolated);
  tbb::parallel_for(
      tbb::blocked_range<std::int64_t>(begin, end, grain),
      [&](const tbb::blocked_range<std::int64_t>& range) {
        const CancellableWork work(cancellation);
        throwIfCancelled();
        body(range.begin(), range.end());
      },
      own);
}

namespace {
std::vector<double> blockValues(std::int64_t count, std::int64_t blockSize,
                                const std::function<double(std::int64_t, std::int64_t)>& block) {
  const std::int64_t blocks = (count + blockSize - 1) / blockSize;
  std::vector<double> values(blocks);
  parallelFor(0, blocks, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t b = first; b < last; ++b) values[b] = block(b * blockSize, std::min(count, (b + 1) * blockSize));
  });
  return values;
}
}  // namespace

double parallelSum(std::int64_t count, std::int64_t blockSize,
                   const std::function<double(std::int64_t, std::int64_t)>& block) {
  double sum = 0;
  for (const double value : blockValues(count, blockSize, block)) sum += value;
  return sum;
}

double parallelMax(std::int64_t count, std::int64_t blockSize,
                   const std::function<double(std::int64_t, std::int64_t)>& block) {
  double largest = 0;
  for (const double value : blockValues(count, blockSize, block)) largest = std::max(largest, value);
  return largest;
}

struct ThreadLimit::Control {
  explicit Control(std::size_t threads) : control(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control control;  // must not be copied: a copy's end would end the limit
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0) control_ = std::make_unique<Control>(static_cast<std::size_t>(threads));
}
ThreadLimit::~ThreadLimit() = default;

int threadCount() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace brisance
