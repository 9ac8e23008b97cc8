#include "base/cancellation.h"

#include "base/progress.h"

namespace brisance {

namespace {
thread_local const Cancellation* atHand = nullptr;
}

CancellableWork::CancellableWork(const Cancellation* cancellation) : before_(atHand) { atHand = cancellation; }
CancellableWork::~CancellableWork() { atHand = before_; }

const Cancellation* cancellationAtHand() { return atHand; }

bool isCancelled() { return atHand && atHand->isRequested(); }

void throwIfCancelled() {
  if (isCancelled()) throw Interrupted();
}

}  // namespace brisance
