// What is taken for a request, and from whom.
#include "view/http_request.h"

#include <gtest/gtest.h>

namespace brisance {
namespace {

constexpr int port = 8123;

HttpRequest asking(const std::string& headers) {
  return parseRequest("GET / HTTP/1.1\r\n" + headers + "\r\n").value_or(HttpRequest{});
}

TEST(HttpRequest, IsReadWithItsPathDecodedAndWithoutTheQuery) {
  const auto request = parseRequest("GET /run/a%20b/%C3%A9?x=%2 HTTP/1.1\r\nHost: x\r\nACCEPT:  y \r\n\r\n");
  ASSERT_TRUE(request);
  EXPECT_EQ(request->method, "GET");
  EXPECT_EQ(request->path, "/run/a b/\xC3\xA9");
  EXPECT_EQ(request->header("accept"), "y");
  EXPECT_TRUE(request->keepsAlive);
}

TEST(HttpRequest, IsWholeWithItsEmptyLine) {
  EXPECT_FALSE(requestLength("GET / HTTP/1.1\r\nHost: x\r\n"));
  EXPECT_EQ(requestLength("GET / HTTP/1.1\r\n\r\nGET"), 18u);
}

TEST(HttpRequest, OthersAreRefused) {
  for (const char* text :
       {"", "GET\r\n\r\n", "GET / HTTP/2\r\n\r\n", "GET http://else/ HTTP/1.1\r\n\r\n", "GET /%zz HTTP/1.1\r\n\r\n",
        "GET /% HTTP/1.1\r\n\r\n", "GET /%00 HTTP/1.1\r\n\r\n", "GET / HTTP/1.1\r\nHost x\r\n\r\n",
        "GET / HTTP/1.1\r\nHost : x\r\n\r\n", "GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n",
        "POST / HTTP/1.1\r\nContent-Length: 3\r\n\r\n", "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n"})
    EXPECT_FALSE(parseRequest(text)) << text;
}

TEST(OurPage, IsOneThatReachesUsUnderANameOfThisMachine) {
  EXPECT_TRUE(isFromOurPage(asking("Host: 127.0.0.1:8123\r\n"), port));
  EXPECT_TRUE(isFromOurPage(asking("Host: LOCALHOST:8123\r\nOrigin: http://localhost:8123\r\n"), port));
}

TEST(OurPage, IsNoneOfAnotherHostPortOrOrigin) {
  for (const char* headers :
       {"", "Host: evil.example\r\n", "Host: evil.example:8123\r\n", "Host: 127.0.0.1\r\n", "Host: 127.0.0.1:80\r\n",
        "Host: 127.0.0.1:8123.evil.example\r\n", "Host: 127.0.0.1:8123\r\nOrigin: http://evil.example\r\n",
        "Host: 127.0.0.1:8123\r\nOrigin: null\r\n", "Host: 127.0.0.1:8123\r\nOrigin: https://127.0.0.1:8123\r\n",
        "Host: 127.0.0.1:8123\r\nOrigin: http://127.0.0.1:8124\r\n"})
    EXPECT_FALSE(isFromOurPage(asking(headers), port)) << headers;
}

}  // namespace
}  // namespace brisance
