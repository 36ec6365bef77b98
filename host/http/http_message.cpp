#include "host/http/http_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "core/text/wording.hpp"

namespace unicursal::host {
namespace {

constexpr const char* token_signs = "!#$%&'*+-.^_`|~";  // RFC 9110, 5.6.2

bool is_alphanumeric(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

bool is_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return is_alphanumeric(c) || (c != '\0' && std::string_view(token_signs).find(c) != std::string::npos);
  });
}

/// Printable ASCII, without the space.
bool is_visible(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < '\x7f'; });
}

bool is_value(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return c == '\t' || (byte >= ' ' && byte != 0x7f);
  });
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// Removes the text up to the separator, and the separator, from `rest`; returns the text.
std::string_view take(std::string_view& rest, std::string_view separator) {
  const std::size_t at = rest.find(separator);
  const std::string_view taken = rest.substr(0, at);
  rest = at == std::string_view::npos ? std::string_view() : rest.substr(at + separator.size());
  return taken;
}

void check_path(std::string_view path) {
  if (path.empty() || path.front() != '/') throw HttpError(400, "a path begins with a slash");
  if (path.find_first_of("%\\") != std::string_view::npos)
    throw HttpError(400, "paths hold neither per cent signs nor backslashes here");
  std::string_view rest = path.substr(1);
  while (!rest.empty()) {
    const std::string_view segment = take(rest, "/");
    if (segment.empty() || segment == "." || segment == "..")
      throw HttpError(400, "a path may not contain empty segments, \".\" or \"..\"");
  }
}

void read_request_line(std::string_view line, RequestHead& head) {
  const std::string_view method = take(line, " ");
  const std::string_view target = take(line, " ");
  if (!is_token(method)) throw HttpError(400, "this is not an HTTP request");
  if (target.size() > longest_target) throw HttpError(414, "the address is too long");
  if (target.empty() || !is_visible(target)) throw HttpError(400, "this is not an HTTP request");
  if (line != "HTTP/1.1" && line != "HTTP/1.0") {
    throw HttpError(line.starts_with("HTTP/") ? 505 : 400, "only HTTP/1.1 is spoken here");
  }
  head.keep_alive = line == "HTTP/1.1";
  head.method = method;
  std::string_view rest = target;
  head.path = take(rest, "?");
  head.query = rest;
  if (head.path.starts_with("//")) head.path.erase(0, 1);  // Home Assistant's library sets the bed's heat so
  check_path(head.path);
}

void read_header(std::string_view line, RequestHead& head) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) throw HttpError(400, "a header has no colon");
  const std::string_view name = line.substr(0, colon);
  const std::string_view value = trimmed(line.substr(colon + 1));
  if (!is_token(name) || !is_value(value)) throw HttpError(400, "a header holds what it must not");
  if (head.headers.size() == most_headers) throw HttpError(431, "there are too many headers");
  head.headers.emplace_back(core::lower(name), value);
}

/// Headers that decide where a request ends, who sent it, or what follows must not occur twice, although RFC
/// 9110 (5.3) allows it for lists: two readers could understand them differently.
void check_single(const RequestHead& head) {
  for (const char* name :
       {"host", "content-length", "transfer-encoding", "connection", "authorization", "origin",
        "content-type", "expect", "upgrade", "sec-fetch-site", "x-api-key", "cookie", "sec-websocket-key",
        "sec-websocket-version", "sec-websocket-protocol"}) {
    const auto same = [name](const auto& header) { return header.first == name; };
    if (std::count_if(head.headers.begin(), head.headers.end(), same) > 1)
      throw HttpError(400, fmt::format("the header {} is there twice", name));
  }
}

std::uint64_t read_length(const std::string& text) {
  std::uint64_t length = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  if (error == std::errc::result_out_of_range) throw HttpError(413, "the body is too large");
  if (error != std::errc() || end != text.data() + text.size())
    throw HttpError(400, "the Content-Length is not a number");
  return length;
}

}  // namespace

std::optional<std::string> RequestHead::header(std::string_view name) const {
  std::optional<std::string> found;
  for (const auto& [known, value] : headers) {
    if (known != name) continue;
    if (found) throw HttpError(400, fmt::format("the header {} is there twice", name));
    found = value;
  }
  return found;
}

std::vector<std::string> RequestHead::list(std::string_view name) const {
  const std::string all = header(name).value_or("");
  std::vector<std::string> words;
  std::string_view rest = all;
  while (!rest.empty()) words.emplace_back(trimmed(take(rest, ",")));
  return words;
}

bool RequestHead::lists(std::string_view name, std::string_view word) const {
  const std::vector<std::string> words = list(name);
  return std::any_of(words.begin(), words.end(),
                     [word](const std::string& one) { return core::lower(one) == word; });
}

RequestHead parse_request(std::string_view text) {
  RequestHead head;
  read_request_line(take(text, "\r\n"), head);
  while (!text.empty()) read_header(take(text, "\r\n"), head);
  check_single(head);
  if (head.header("transfer-encoding")) throw HttpError(411, "send the body's length, not chunks");
  if (const auto length = head.header("content-length")) head.content_length = read_length(*length);
  if (head.lists("connection", "close")) head.keep_alive = false;
  return head;
}

HttpError HttpError::wrong_method(const std::string& sentence, std::string allowed) {
  HttpError error(405, sentence);
  error.allow_ = std::move(allowed);
  return error;
}

HttpError HttpError::late(std::chrono::milliseconds wait) const {
  HttpError error = *this;
  error.wait_ = wait;
  return error;
}

const char* HttpError::usual_code(int status) {
  constexpr std::pair<int, const char*> known[] = {
      {400, "bad_request"},  {401, "wrong_token"}, {403, "no_right"},    {404, "not_found"},
      {405, "wrong_method"}, {408, "too_slow"},    {409, "conflict"},    {411, "no_length"},
      {413, "too_large"},    {414, "too_large"},   {415, "wrong_type"},  {421, "wrong_host"},
      {422, "bad_job"},      {426, "no_upgrade"},  {431, "too_large"},   {502, "no_answer"},
      {503, "too_many"},     {504, "no_answer"},   {505, "bad_request"}, {507, "no_room"}};
  for (const auto& [number, code] : known) {
    if (number == status) return code;
  }
  return "internal";
}

Response error_response(const HttpError& error) {
  const nlohmann::json body = {{"version", 1}, {"error", error.what()}, {"code", error.code()}};
  Response response;
  response.status = error.status();
  response.body = body.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  if (error.status() == 401) response.headers.emplace_back("WWW-Authenticate", "Bearer");
  if (error.status() == 405) response.headers.emplace_back("Allow", error.allow());
  if (error.status() == 426) response.headers.emplace_back("Upgrade", "websocket");
  return response;
}

std::string to_text(const Response& response, bool keep_alive, bool with_body) {
  std::string text = fmt::format("HTTP/1.1 {} {}\r\n", response.status, status_words(response.status));
  const auto usual = [&](const char* name, const char* value) {
    const auto same = [name](const auto& header) { return header.first == name; };
    if (std::none_of(response.headers.begin(), response.headers.end(), same))
      text += fmt::format("{}: {}\r\n", name, value);
  };
  const bool has_content = response.status >= 200 && response.status != 204 && response.status != 304;
  if (has_content) {
    text += fmt::format("Content-Type: {}\r\nContent-Length: {}\r\n", response.type, response.body.size());
    usual("Cache-Control", "no-store");
    usual("X-Content-Type-Options", "nosniff");
    usual("Content-Security-Policy", "default-src 'none'");
  }
  if (response.status >= 200) text += keep_alive ? "Connection: keep-alive\r\n" : "Connection: close\r\n";
  for (const auto& [name, value] : response.headers) text += fmt::format("{}: {}\r\n", name, value);
  return text + "\r\n" + (with_body && has_content ? response.body : "");
}

const char* status_words(int status) {
  constexpr std::pair<int, const char*> known[] = {{101, "Switching Protocols"},
                                                   {200, "OK"},
                                                   {201, "Created"},
                                                   {202, "Accepted"},
                                                   {204, "No Content"},
                                                   {304, "Not Modified"},
                                                   {400, "Bad Request"},
                                                   {401, "Unauthorized"},
                                                   {403, "Forbidden"},
                                                   {404, "Not Found"},
                                                   {405, "Method Not Allowed"},
                                                   {408, "Request Timeout"},
                                                   {409, "Conflict"},
                                                   {411, "Length Required"},
                                                   {413, "Content Too Large"},
                                                   {414, "URI Too Long"},
                                                   {415, "Unsupported Media Type"},
                                                   {421, "Misdirected Request"},
                                                   {422, "Unprocessable Content"},
                                                   {426, "Upgrade Required"},
                                                   {431, "Request Header Fields Too Large"},
                                                   {500, "Internal Server Error"},
                                                   {502, "Bad Gateway"},
                                                   {503, "Service Unavailable"},
                                                   {504, "Gateway Timeout"},
                                                   {505, "HTTP Version Not Supported"},
                                                   {507, "Insufficient Storage"}};
  for (const auto& [number, words] : known) {
    if (number == status) return words;
  }
  return "Unknown";
}

}  // namespace unicursal::host
