// A client that says what no browser would.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace brisance::test {

class LoopbackClient {
 public:
  explicit LoopbackClient(int port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    isConnected_ = connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~LoopbackClient() { close(socket_); }
  LoopbackClient(LoopbackClient&& other) noexcept : socket_(other.socket_), isConnected_(other.isConnected_) {
    other.socket_ = -1;
  }
  LoopbackClient(const LoopbackClient&) = delete;
  LoopbackClient& operator=(const LoopbackClient&) = delete;

  bool isConnected() const { return isConnected_; }
  bool say(const std::string& bytes) const {
    return send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  /// All until the server closes, or is silent for so long.
  std::string hear(int milliseconds = 20000) const {
    std::string heard;
    char bytes[65536];
    pollfd watched{socket_, POLLIN, 0};
    while (poll(&watched, 1, milliseconds) > 0) {
      const ssize_t count = recv(socket_, bytes, sizeof bytes, 0);
      if (count <= 0) break;
      heard.append(bytes, static_cast<std::size_t>(count));
    }
    return heard;
  }

 private:
  int socket_;
  bool isConnected_ = false;
};

inline std::string requestFor(const std::string& path, int port, const std::string& more = "") {
  return "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\nConnection: close\r\n" + more +
         "\r\n";
}

/// What a server answers to such a request; empty: nothing.
inline std::string answerTo(const std::string& request, int port) {
  const LoopbackClient client(port);
  return client.isConnected() && client.say(request) ? client.hear() : "";
}

inline int statusOf(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : 0;
}

inline std::string bodyOf(const std::string& answer) { return answer.substr(answer.find("\r\n\r\n") + 4); }

}  // namespace brisance::test
