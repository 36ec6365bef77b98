// A client of the daemon's WebSockets, over a real socket.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tests/host/support/raw_http.hpp"

namespace unicursal::test {

class WebSocketClient {
 public:
  /// `more`: further headers, each with its line end.
  WebSocketClient(int port, const std::string& target, const std::string& more = {}) : connection_(port) {
    connection_.send("GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n" +
                     more +
                     "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                     "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    status_ = status_of(connection_.read_until("\r\n\r\n"));
  }

  /// Of the handshake; 101 if it is open.
  int status() const { return status_; }
  void say(const std::string& text) {
    const std::string mask = "\x11\x22\x33\x44";
    std::string bytes = "\x81";
    bytes += static_cast<char>(0x80 | (text.size() < 126 ? text.size() : 126));
    if (text.size() >= 126) bytes += {static_cast<char>(text.size() >> 8), static_cast<char>(text.size())};
    bytes += mask;
    for (std::size_t i = 0; i < text.size(); ++i) bytes += static_cast<char>(text[i] ^ mask[i % 4]);
    connection_.send(bytes);
  }
  /// The next text; absent when the daemon has closed, with the code in closed_with(). Pings are passed over.
  std::optional<nlohmann::json> next() {
    for (;;) {
      const std::string head = connection_.read(2);
      if (head.size() < 2) return std::nullopt;
      std::size_t size = static_cast<unsigned char>(head[1]);
      if (size >= 126) {
        const std::string more = connection_.read(size == 126 ? 2 : 8);
        size = 0;
        for (const char byte : more) size = size << 8 | static_cast<unsigned char>(byte);
      }
      const std::string payload = connection_.read(size);
      const int kind = head[0] & 0x0f;
      if (kind == 1) return nlohmann::json::parse(payload);
      if (kind != 8) continue;
      closed_with_ =
          static_cast<unsigned char>(payload.at(0)) << 8 | static_cast<unsigned char>(payload.at(1));
      return std::nullopt;
    }
  }
  int closed_with() const { return closed_with_; }

 private:
  RawConnection connection_;
  int status_ = 0, closed_with_ = 0;
};

}  // namespace unicursal::test
