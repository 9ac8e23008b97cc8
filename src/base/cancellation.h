// Work that can be cut short in its middle: a flag that loops look at, wherever they are called from.
#pragma once

#include <atomic>

namespace brisance {

/// Asks work to end. Any thread may ask.
class Cancellation {
 public:
  void request() { requested_.store(true, std::memory_order_relaxed); }
  bool isRequested() const { return requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_ = false;
};

/// While it lives, what this thread does ends with Interrupted (base/progress.h) soon after `cancellation` was asked
/// for: each piece of a parallel loop looks, on whatever thread it runs, and so does throwIfCancelled. None: never.
class CancellableWork {
 public:
  explicit CancellableWork(const Cancellation* cancellation);
  ~CancellableWork();
  CancellableWork(const CancellableWork&) = delete;
  CancellableWork& operator=(const CancellableWork&) = delete;

 private:
  const Cancellation* before_;
};

/// Of the work that this thread does now; none: it cannot be cut.
const Cancellation* cancellationAtHand();
/// Whether the work at hand is to end.
bool isCancelled();
/// For long loops on one thread. Costs a look at two places of memory.
void throwIfCancelled();

}  // namespace brisance
