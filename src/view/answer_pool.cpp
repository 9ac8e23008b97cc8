#include "view/answer_pool.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <exception>
#include <utility>

namespace brisance {

AnswerPool::AnswerPool(int threads, std::function<HttpAnswer(const HttpRequest&)> answering)
    : answering_(std::move(answering)), bell_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  for (int n = 0; n < threads; ++n) threads_.emplace_back([this] { work(); });
}

AnswerPool::~AnswerPool() {
  {
    const std::lock_guard lock(guard_);
    ends_ = true;
  }
  asked_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  close(bell_);
}

void AnswerPool::ask(std::uint64_t connection, HttpRequest request) {
  {
    const std::lock_guard lock(guard_);
    questions_.push_back({connection, std::move(request)});
  }
  asked_.notify_one();
}

void AnswerPool::forget(std::uint64_t connection) {
  const std::lock_guard lock(guard_);
  std::erase_if(questions_, [&](const Question& question) { return question.connection == connection; });
}

std::vector<ReadyAnswer> AnswerPool::take() {
  std::uint64_t rung = 0;
  [[maybe_unused]] const auto count = read(bell_, &rung, sizeof rung);  // nothing to read: nothing is ready
  const std::lock_guard lock(guard_);
  return std::exchange(ready_, {});
}

/// A run that is being written may miss a file for a moment; its reader says so.
HttpAnswer AnswerPool::answerOrTrouble(const HttpRequest& request) const {
  try {
    return answering_(request);
  } catch (const std::exception& trouble) {
    return refusal(503, trouble.what());
  }
}

void AnswerPool::work() {
  for (;;) {
    std::unique_lock lock(guard_);
    asked_.wait(lock, [&] { return ends_ || !questions_.empty(); });
    if (ends_) return;
    const Question question = std::move(questions_.front());
    questions_.pop_front();
    lock.unlock();
    HttpAnswer answer = answerOrTrouble(question.request);
    lock.lock();
    ready_.push_back({question.connection, std::move(answer)});
    lock.unlock();
    const std::uint64_t ring = 1;
    [[maybe_unused]] const auto count = write(bell_, &ring, sizeof ring);  // full: it rings already
  }
}

}  // namespace brisance
