// What a browser asks, and what it is told: the little of HTTP/1.1 (RFC 9112) that a player needs.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace brisance {

struct HttpRequest {
  std::string method;                          ///< "GET"
  std::string path;                            ///< decoded, without query: "/data/state.json"
  std::map<std::string, std::string> headers;  ///< names in small letters
  bool keepsAlive = true;                      ///< another request may follow

  /// Empty where it is not there.
  std::string header(const std::string& name) const;
};

struct HttpAnswer {
  int status = 200;
  std::string type = "application/json";
  std::shared_ptr<const std::string> body = std::make_shared<std::string>();
  bool changes = false;  ///< the same question may be answered otherwise later
  bool page = false;     ///< scripts of it run
};

HttpAnswer refusal(int status, const std::string& why);
HttpAnswer answerWith(const std::string& type, std::string body);

/// Bytes of the request at the start of what was received, up to and with its empty line; nothing: not whole yet.
std::optional<std::size_t> requestLength(std::string_view received);

/// Nothing for text that is no request, or one with a body.
std::optional<HttpRequest> parseRequest(std::string_view text);

/// "%2e" to "."; nothing for what is no encoding, or hides a zero byte.
std::optional<std::string> percentDecoded(std::string_view text);

/// Status line and headers of an answer, and whether the connection stays.
std::string headOf(const HttpAnswer& answer, bool keepsAlive);

/// Whether a request comes from a page of ours: its Host is a name of this machine with our port, and so is its Origin
/// where it names one. Other pages in the same browser, by whatever name they reach us, are refused.
bool isFromOurPage(const HttpRequest& request, int port);

}  // namespace brisance
