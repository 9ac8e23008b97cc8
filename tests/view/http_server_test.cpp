// The server keeps answering, whatever its clients do or leave undone.
#include "view/http_server.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "base/check.h"
#include "view/loopback_client.h"

namespace brisance {
namespace {

using test::answerTo;
using test::bodyOf;
using test::LoopbackClient;
using test::requestFor;
using test::statusOf;

/// Says the path that it was asked for; "/large" is ten megabytes, "/trouble" throws.
HttpAnswer echo(const HttpRequest& request) {
  constexpr std::size_t tenMegabytes = 10'000'000;
  if (request.path == "/large") return answerWith("text/plain", std::string(tenMegabytes, 'x'));
  if (request.path == "/trouble") throw DamagedFile("gas.vdb: is damaged");
  return answerWith("text/plain", request.path);
}

class RunningServer {
 public:
  explicit RunningServer(const ServerLimits& limits = {})
      : server_(0, echo, limits), thread_([this] { server_.serve([this] { return stops_.load(); }); }) {}
  ~RunningServer() {
    stops_ = true;
    thread_.join();
  }
  int port() const { return server_.port(); }
  std::string get(const std::string& path, const std::string& more = "") const {
    return answerTo(requestFor(path, port(), more), port());
  }

 private:
  std::atomic<bool> stops_ = false;
  HttpServer server_;
  std::thread thread_;
};

TEST(HttpServer, AnswersWhatItIsAsked) {
  const RunningServer server;
  EXPECT_EQ(statusOf(server.get("/a/b")), 200);
  EXPECT_EQ(bodyOf(server.get("/a/b")), "/a/b");
  EXPECT_EQ(bodyOf(server.get("/large")).size(), 10'000'000u);
}

TEST(HttpServer, OneConnectionMayAskOftenAndAhead) {
  const RunningServer server;
  const std::string host = "Host: localhost:" + std::to_string(server.port()) + "\r\n";
  const std::string heard =
      answerTo("GET /first HTTP/1.1\r\n" + host + "\r\nGET /second HTTP/1.1\r\n" + host + "Connection: close\r\n\r\n",
               server.port());
  const std::size_t first = heard.find("\r\n\r\n/first"), second = heard.find("\r\n\r\n/second");
  EXPECT_NE(first, std::string::npos) << heard;
  EXPECT_NE(second, std::string::npos) << heard;
  EXPECT_LT(first, second);
}

TEST(HttpServer, TellsTroubleInOneLineAndGoesOn) {
  const RunningServer server;
  EXPECT_EQ(statusOf(server.get("/trouble")), 503);
  EXPECT_EQ(bodyOf(server.get("/trouble")), "gas.vdb: is damaged\n");
  EXPECT_EQ(statusOf(server.get("/a")), 200);
}

TEST(HttpServer, RefusesForeignHostsAndOriginsAndOtherMethods) {
  const RunningServer server;
  EXPECT_EQ(statusOf(server.get("/a", "Origin: http://evil.example\r\n")), 403);
  EXPECT_EQ(statusOf(answerTo("GET /a HTTP/1.1\r\nHost: evil.example\r\n\r\n", server.port())), 403);
  EXPECT_EQ(statusOf(answerTo("POST /a HTTP/1.1\r\nHost: x\r\n\r\n", server.port())), 405);
  EXPECT_EQ(statusOf(answerTo("nonsense\r\n\r\n", server.port())), 400);
  EXPECT_EQ(statusOf(server.get("/" + std::string(20000, 'a'))), 431);
}

TEST(HttpServer, HeadHasNoBody) {
  const RunningServer server;
  const std::string heard =
      answerTo("HEAD /a HTTP/1.1\r\nHost: localhost:" + std::to_string(server.port()) + "\r\nConnection: close\r\n\r\n",
               server.port());
  EXPECT_NE(heard.find("Content-Length: 2"), std::string::npos) << heard;
  EXPECT_EQ(bodyOf(heard), "");
}

TEST(HttpServer, AnswersAmongAThousandConnectionsThatSayNothing) {
  const RunningServer server;
  std::vector<LoopbackClient> silent;
  for (int n = 0; n < 1000; ++n) {
    silent.emplace_back(server.port());
    if (n % 100 == 0) {
      EXPECT_EQ(statusOf(server.get("/a")), 200) << n;
    }
  }
  EXPECT_EQ(statusOf(server.get("/a")), 200);
}

TEST(HttpServer, AnswersBesideClientsThatSpeakOrHearSlowly) {
  const RunningServer server;
  std::vector<LoopbackClient> slow;
  for (int n = 0; n < 20; ++n) {
    slow.emplace_back(server.port());
    EXPECT_TRUE(slow.back().say(n % 2 ? "GET /large HT" : requestFor("/large", server.port())));
  }
  EXPECT_EQ(statusOf(server.get("/a")), 200);
}

TEST(HttpServer, ClosesWhoDoesNotFinishARequest) {
  ServerLimits limits;
  limits.requestSeconds = 0.3;
  const RunningServer server(limits);
  const LoopbackClient client(server.port());
  client.say("GET / HTTP/1.1\r\n");
  EXPECT_EQ(client.hear(), "");  // and not after the client's own patience
}

TEST(HttpServer, ClosesWhoTakesNothingOfAnAnswer) {
  ServerLimits limits;
  limits.stalledSeconds = 0.3;
  const RunningServer server(limits);
  const LoopbackClient client(server.port());
  client.say(requestFor("/large", server.port()));
  usleep(1'500'000);
  EXPECT_LT(client.hear().size(), 10'000'000u);
}

TEST(HttpServer, APortThatIsTakenIsToldInOneLine) {
  const RunningServer server;
  try {
    const HttpServer second(server.port(), echo);
    FAIL() << "two listen on one port";
  } catch (const Error& trouble) {
    EXPECT_EQ(trouble.code, ExitCode::failed);
    EXPECT_NE(std::string(trouble.what()).find("--port 0"), std::string::npos);
  }
}

}  // namespace
}  // namespace brisance
