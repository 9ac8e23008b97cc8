// A small server for one person's browser: loopback only, everything bounded.
#pragma once

#include <functional>
#include <memory>

#include "base/progress.h"
#include "view/http_request.h"

namespace brisance {

/// Limits that no client can pass.
struct ServerLimits {
  std::size_t connections = 200;     ///< at once; beyond them the one that was silent longest is closed
  std::size_t requestBytes = 16384;  ///< of a request
  double requestSeconds = 5;         ///< from a connection's start, or from its last answer, to the end of a request
  double stalledSeconds = 20;        ///< without a byte taken of an answer
  int threads = 2;                   ///< that make answers
};

/// One thread moves bytes and waits for no one; a few others make the answers.
class HttpServer {
 public:
  using Answering = std::function<HttpAnswer(const HttpRequest&)>;

  /// Listens on 127.0.0.1; port 0: any that is free. Throws Error(failed) where it is taken.
  HttpServer(int port, Answering answering, const ServerLimits& limits = {});
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;
  /// Serves until asked to stop, which it notices within a tenth of a second.
  void serve(const StopRequested& stop);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace brisance
