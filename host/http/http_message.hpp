// HTTP/1.1 messages as far as the API needs them, read strictly: anything unusual is refused, since requests
// are smuggled in messages that two readers understand differently. No chunked bodies, no folded headers, no
// percent signs in paths (no name of the API needs them).
//
// RESTinio is in Debian but does not fit: version 0.6.16 closes the connection without an answer on a
// malformed, too large or too slow request (all five kinds were tried). It also shows a request only after
// its whole body has arrived, so that the body of a client without the token would be kept in memory. Here a
// client gets a 4xx before its body is read.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace unicursal::host {

/// Bytes from the first to the blank line; more is refused with 431.
inline constexpr std::size_t longest_head = 16 * 1024;
inline constexpr std::size_t longest_target = 2048;  ///< bytes; more is refused with 414
inline constexpr std::size_t most_headers = 64;

/// A refused request: the status to answer with, a code for programs, which stays the same, and a sentence.
/// Without a code it is the status's usual one.
class HttpError : public std::runtime_error {
 public:
  HttpError(int status, const std::string& sentence) : HttpError(status, usual_code(status), sentence) {}
  /// `code`: lower case with underscores, for example "not_json".
  HttpError(int status, const char* code, const std::string& sentence)
      : std::runtime_error(sentence), status_(status), code_(code) {}
  /// For 405: the methods of the address.
  static HttpError wrong_method(const std::string& sentence, std::string allowed);

  /// The same, to be answered after this time.
  HttpError late(std::chrono::milliseconds wait) const;

  int status() const { return status_; }
  const char* code() const { return code_; }
  const std::string& allow() const { return allow_; }
  std::chrono::milliseconds wait() const { return wait_; }

 private:
  static const char* usual_code(int status);

  int status_;
  const char* code_;  ///< a literal
  std::string allow_;
  std::chrono::milliseconds wait_{0};
};

struct RequestHead {
  std::string method;  ///< "GET"
  std::string path;    ///< "/api/status": begins with a slash, without ".", ".." and empty segments;
                       ///< an empty one at the very beginning is left out
  std::string query;   ///< behind the question mark
  std::vector<std::pair<std::string, std::string>> headers;  ///< names in lower case
  std::uint64_t content_length = 0;                          ///< bytes
  bool keep_alive = true;
  bool by_socket = false;        ///< it came through the server's Unix socket, from this user or root
  std::uint64_t connection = 0;  ///< number of the connection that it came by
  std::string peer;  ///< the client's address, "192.168.1.5"; empty: unknown, or the Unix socket's

  /// `name` in lower case; absent if there is none. Throws HttpError 400 if there are several.
  std::optional<std::string> header(std::string_view name) const;
  /// The words of a list such as "unicursal.v1, token.TOKEN"; empty if there is no such header.
  std::vector<std::string> list(std::string_view name) const;
  /// Whether a list such as "keep-alive, Upgrade" contains this word, which is in lower case.
  bool lists(std::string_view name, std::string_view word) const;
};

class BodyTaker;  // http_server.hpp

struct Request : RequestHead {
  std::string body;
  std::shared_ptr<BodyTaker> taker;  ///< has got the body, which is empty here; null: nobody has
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  /// Beside the usual ones, or instead of them: an answer is not kept, its type is not guessed, and a browser
  /// that shows it runs nothing in it.
  std::vector<std::pair<std::string, std::string>> headers;
};

/// Everything before the blank line. Throws HttpError 400, 411, 414, 431, 501 or 505.
RequestHead parse_request(std::string_view head);

/// {"version": 1, "error": "…", "code": "…"} with the headers that RFC 9110 asks for beside 401, 405 and 426.
Response error_response(const HttpError& error);

/// As bytes on the wire. `with_body`: false for the answer to HEAD, which has the headers alone.
std::string to_text(const Response& response, bool keep_alive, bool with_body = true);

const char* status_words(int status);

}  // namespace unicursal::host
