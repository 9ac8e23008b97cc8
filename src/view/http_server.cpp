#include "view/http_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <map>
#include <vector>

#include "base/check.h"
#include "view/answer_pool.h"

namespace brisance {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

[[noreturn]] void throwCannotListen(int port, int reason) {
  throw Error(ExitCode::failed, fmt::format("brisance: cannot listen on 127.0.0.1:{}: {}; --port 0 takes a free one",
                                            port, std::strerror(reason)));
}

int listeningSocket(int port) {
  const int socketNumber = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socketNumber < 0) throwCannotListen(port, errno);
  const int yes = 1;
  setsockopt(socketNumber, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  constexpr int waiting = 128;
  if (bind(socketNumber, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      listen(socketNumber, waiting) != 0) {
    const int reason = errno;
    close(socketNumber);
    throwCannotListen(port, reason);
  }
  return socketNumber;
}

int portOf(int socketNumber) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(socketNumber, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

/// A client, and how far it is.
struct Connection {
  enum class State { reading, waiting, writing };
  int socket = -1;
  State state = State::reading;
  Clock::time_point since = Clock::now();  ///< of the state, or of the last byte taken of an answer
  std::string received{};
  bool keepsAlive = false, wantsBody = true;
  std::string head{};
  std::shared_ptr<const std::string> body{};
  std::size_t sent = 0;

  short events() const {
    if (state == State::waiting) return 0;  // poll still tells when the other side is gone
    return state == State::reading ? POLLIN : POLLOUT;
  }
};

}  // namespace

class HttpServer::Impl {
 public:
  Impl(int port, Answering answering, const ServerLimits& limits)
      : limits_(limits),
        listener_(listeningSocket(port)),
        port_(portOf(listener_)),
        pool_(limits.threads, std::move(answering)) {}
  ~Impl() {
    for (const auto& [id, connection] : connections_) close(connection.socket);
    close(listener_);
  }

  int port() const { return port_; }

  void serve(const StopRequested& stop) {
    while (!stop()) {
      waitForSomething();
      for (ReadyAnswer& ready : pool_.take()) beginAnswer(ready.connection, std::move(ready.answer));
      closeLate();
    }
  }

 private:
  void waitForSomething() {
    std::vector<pollfd> watched{{listener_, POLLIN, 0}, {pool_.bell(), POLLIN, 0}};
    std::vector<std::uint64_t> ids;
    for (const auto& [id, connection] : connections_) {
      watched.push_back({connection.socket, connection.events(), 0});
      ids.push_back(id);
    }
    constexpr int milliseconds = 100;  // a wish to stop is noticed so soon
    if (poll(watched.data(), watched.size(), milliseconds) <= 0) return;
    for (std::size_t n = 0; n < ids.size(); ++n)
      if (watched[n + 2].revents != 0) goOn(ids[n], watched[n + 2].revents);
    if (watched[0].revents != 0) acceptAll();
  }

  void acceptAll() {
    for (;;) {
      const int socket = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
      if (socket < 0) return;
      const int yes = 1;
      setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
      if (connections_.size() >= limits_.connections) closeMostSilent();
      connections_.emplace(++lastId_, Connection{socket});
    }
  }

  /// Whoever is waited for has done its part and stays, as long as there is another.
  void closeMostSilent() {
    const auto rank = [](const auto& item) {
      return std::pair(item.second.state == Connection::State::waiting, item.second.since);
    };
    const auto silent = std::min_element(connections_.begin(), connections_.end(),
                                         [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    if (silent != connections_.end()) end(silent->first);
  }

  void closeLate() {
    std::vector<std::uint64_t> late;
    for (const auto& [id, connection] : connections_) {
      const double seconds = secondsSince(connection.since);
      const bool isLate = (connection.state == Connection::State::reading && seconds > limits_.requestSeconds) ||
                          (connection.state == Connection::State::writing && seconds > limits_.stalledSeconds);
      if (isLate) late.push_back(id);
    }
    for (const std::uint64_t id : late) end(id);
  }

  void end(std::uint64_t id) {
    close(connections_.at(id).socket);
    connections_.erase(id);
    pool_.forget(id);
  }

  void goOn(std::uint64_t id, int events) {
    if ((events & (POLLERR | POLLHUP | POLLNVAL)) != 0) return end(id);
    switch (connections_.at(id).state) {
      case Connection::State::reading:
        return receive(id);
      case Connection::State::writing:
        return send(id);
      case Connection::State::waiting:
        return;
    }
  }

  void receive(std::uint64_t id) {
    Connection& connection = connections_.at(id);
    char bytes[4096];
    const ssize_t count = recv(connection.socket, bytes, sizeof bytes, 0);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (count <= 0) return end(id);
    connection.received.append(bytes, static_cast<std::size_t>(count));
    takeRequest(id);
  }

  void takeRequest(std::uint64_t id) {
    Connection& connection = connections_.at(id);
    const auto length = requestLength(connection.received);
    connection.keepsAlive = connection.wantsBody = false;
    if (length.value_or(connection.received.size()) > limits_.requestBytes)
      return beginAnswer(id, refusal(431, "the request is too long"));
    if (!length) return;
    auto request = parseRequest(std::string_view(connection.received).substr(0, *length));
    connection.received.erase(0, *length);
    if (!request) return beginAnswer(id, refusal(400, "no request that is understood here"));
    connection.wantsBody = request->method != "HEAD";
    connection.keepsAlive = request->keepsAlive;
    if (request->method != "GET" && request->method != "HEAD")
      return beginAnswer(id, refusal(405, "only GET and HEAD are answered"));
    if (!isFromOurPage(*request, port_)) return beginAnswer(id, refusal(403, "not asked by a page of this player"));
    connection.state = Connection::State::waiting;
    connection.since = Clock::now();
    pool_.ask(id, std::move(*request));
  }

  void beginAnswer(std::uint64_t id, HttpAnswer answer) {
    const auto found = connections_.find(id);
    if (found == connections_.end()) return;  // it left meanwhile
    Connection& connection = found->second;
    if (answer.status >= 400 && answer.status != 404 && answer.status != 503) connection.keepsAlive = false;
    connection.state = Connection::State::writing;
    connection.since = Clock::now();
    connection.head = headOf(answer, connection.keepsAlive);
    connection.body = std::move(answer.body);
    connection.sent = 0;
    send(id);
  }

  /// What is left of head and body.
  static std::string_view unsent(const Connection& connection) {
    if (connection.sent < connection.head.size()) return std::string_view(connection.head).substr(connection.sent);
    if (!connection.wantsBody && connection.head.find(" 200 ") != std::string::npos) return {};
    return std::string_view(*connection.body).substr(connection.sent - connection.head.size());
  }

  void send(std::uint64_t id) {
    Connection& connection = connections_.at(id);
    for (std::string_view rest = unsent(connection); !rest.empty(); rest = unsent(connection)) {
      const ssize_t count = ::send(connection.socket, rest.data(), rest.size(), MSG_NOSIGNAL);
      if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
      if (count <= 0) return end(id);
      connection.sent += static_cast<std::size_t>(count);
      connection.since = Clock::now();
    }
    finish(id);
  }

  void finish(std::uint64_t id) {
    Connection& connection = connections_.at(id);
    if (!connection.keepsAlive) return end(id);
    connection.state = Connection::State::reading;
    connection.body.reset();
    if (!connection.received.empty()) takeRequest(id);
  }

  ServerLimits limits_;
  int listener_, port_;
  std::uint64_t lastId_ = 0;
  std::map<std::uint64_t, Connection> connections_;
  AnswerPool pool_;
};

HttpServer::HttpServer(int port, Answering answering, const ServerLimits& limits)
    : impl_(std::make_unique<Impl>(port, std::move(answering), limits)) {}
HttpServer::~HttpServer() = default;
int HttpServer::port() const { return impl_->port(); }
void HttpServer::serve(const StopRequested& stop) { impl_->serve(stop); }

}  // namespace brisance
