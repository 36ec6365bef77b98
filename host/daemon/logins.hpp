// Sessions of browsers: a page logs in with the token or a key, and its pictures and WebSocket are let in by
// a cookie, since they cannot carry a token. A session is bound to the secret that it was opened with, and
// void together with it. Sessions are in memory only; the oldest gives way.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>

namespace unicursal::host {

class Logins {
 public:
  static constexpr std::size_t most = 64;

  /// 128 random bits in hexadecimal, which only this browser knows.
  std::string open(const std::string& secret);
  void close(const std::string& session);
  /// What the session was opened with; absent if it is not known.
  std::optional<std::string> secret_of(const std::string& session) const;

 private:
  struct Login {
    std::string session, secret;
  };
  std::deque<Login> logins_;
};

}  // namespace unicursal::host
