#include "view/http_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace brisance {

namespace {

constexpr std::string_view lineEnd = "\r\n";

std::string inSmallLetters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char letter) { return static_cast<char>(std::tolower(static_cast<unsigned char>(letter))); });
  return text;
}

std::string_view trimmed(std::string_view text) {
  const auto isBlank = [](char letter) { return letter == ' ' || letter == '\t'; };
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

/// Takes what stands before `mark` off the text, and the mark; nothing where there is none.
std::optional<std::string_view> takeUntil(std::string_view& text, std::string_view mark) {
  const std::size_t place = text.find(mark);
  if (place == std::string_view::npos) return std::nullopt;
  const std::string_view taken = text.substr(0, place);
  text.remove_prefix(place + mark.size());
  return taken;
}

bool parseHeaders(std::string_view text, std::map<std::string, std::string>& headers) {
  while (const auto line = takeUntil(text, lineEnd)) {
    if (line->empty()) return true;
    std::string_view rest = *line;
    const auto name = takeUntil(rest, ":");
    if (!name || name->empty() || name->find_first_of(" \t") != std::string_view::npos) return false;
    // Of two that say who asks, none can be believed.
    if (!headers.try_emplace(inSmallLetters(std::string(*name)), trimmed(rest)).second) return false;
  }
  return false;
}

const char* reason(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 408:
      return "Request Timeout";
    case 431:
      return "Request Header Fields Too Large";
    default:
      return "Service Unavailable";
  }
}

}  // namespace

std::string HttpRequest::header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? "" : found->second;
}

HttpAnswer answerWith(const std::string& type, std::string body) {
  return {200, type, std::make_shared<const std::string>(std::move(body))};
}

HttpAnswer refusal(int status, const std::string& why) {
  return {status, "text/plain; charset=utf-8", std::make_shared<const std::string>(why + "\n"), true};
}

std::optional<std::size_t> requestLength(std::string_view received) {
  const std::size_t end = received.find("\r\n\r\n");
  if (end == std::string_view::npos) return std::nullopt;
  return end + 4;
}

std::optional<std::string> percentDecoded(std::string_view text) {
  std::string decoded;
  for (std::size_t n = 0; n < text.size(); ++n) {
    if (text[n] != '%') {
      decoded += text[n];
      continue;
    }
    unsigned value = 0;
    const std::string_view digits = text.substr(std::min(n + 1, text.size()), 2);
    const auto [end, trouble] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (digits.size() < 2 || trouble != std::errc() || end != digits.data() + 2 || value == 0) return std::nullopt;
    decoded += static_cast<char>(value);
    n += 2;
  }
  return decoded;
}

std::optional<HttpRequest> parseRequest(std::string_view text) {
  HttpRequest request;
  const auto method = takeUntil(text, " ");
  const auto target = takeUntil(text, " ");
  const auto version = takeUntil(text, lineEnd);
  if (!method || !target || !version || !target->starts_with('/') || !version->starts_with("HTTP/1."))
    return std::nullopt;
  const auto path = percentDecoded(target->substr(0, target->find('?')));
  if (!path || !parseHeaders(text, request.headers)) return std::nullopt;
  const std::string length = request.header("content-length");
  if (!request.header("transfer-encoding").empty() || (!length.empty() && length != "0")) return std::nullopt;
  request.method = *method;
  request.path = *path;
  request.keepsAlive = *version == "HTTP/1.1" && inSmallLetters(request.header("connection")) != "close";
  return request;
}

std::string headOf(const HttpAnswer& answer, bool keepsAlive) {
  std::string head = fmt::format(
      "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: {}\r\nConnection: {}\r\n"
      "X-Content-Type-Options: nosniff\r\nCross-Origin-Resource-Policy: same-origin\r\nReferrer-Policy: "
      "no-referrer\r\n",
      answer.status, reason(answer.status), answer.type, answer.body->size(), answer.changes ? "no-store" : "no-cache",
      keepsAlive ? "keep-alive" : "close");
  head += answer.page ? "Content-Security-Policy: default-src 'self' blob: data:; script-src 'unsafe-inline' blob:; "
                        "style-src 'unsafe-inline'; frame-ancestors 'none'\r\n"
                      : "Content-Security-Policy: sandbox; default-src 'none'\r\n";
  return head + "\r\n";
}

bool isFromOurPage(const HttpRequest& request, int port) {
  const auto isOurs = [&](const std::string& host) {
    return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
  };
  if (!isOurs(inSmallLetters(request.header("host")))) return false;
  const std::string origin = inSmallLetters(request.header("origin")), scheme = "http://";
  return origin.empty() || (origin.starts_with(scheme) && isOurs(origin.substr(scheme.size())));
}

}  // namespace brisance
