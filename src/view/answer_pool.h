// A few threads that make answers, and a bell that rings in poll() when one is ready.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "view/http_request.h"

namespace brisance {

/// An answer and whose it is.
struct ReadyAnswer {
  std::uint64_t connection;
  HttpAnswer answer;
};

class AnswerPool {
 public:
  AnswerPool(int threads, std::function<HttpAnswer(const HttpRequest&)> answering);
  /// Waits for answers that are being made, and for no others.
  ~AnswerPool();
  AnswerPool(const AnswerPool&) = delete;
  AnswerPool& operator=(const AnswerPool&) = delete;

  void ask(std::uint64_t connection, HttpRequest request);
  /// Forgets what nobody waits for any more.
  void forget(std::uint64_t connection);
  /// Those that became ready since the last call.
  std::vector<ReadyAnswer> take();
  /// Readable when there are some.
  int bell() const { return bell_; }

 private:
  struct Question {
    std::uint64_t connection;
    HttpRequest request;
  };
  void work();
  HttpAnswer answerOrTrouble(const HttpRequest& request) const;

  std::function<HttpAnswer(const HttpRequest&)> answering_;
  int bell_;
  std::mutex guard_;
  std::condition_variable asked_;
  bool ends_ = false;
  std::deque<Question> questions_;
  std::vector<ReadyAnswer> ready_;
  std::vector<std::thread> threads_;
};

}  // namespace brisance
