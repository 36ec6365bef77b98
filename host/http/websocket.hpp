// WebSocket frames (RFC 6455) of a server that sends text. From clients only control frames matter; other
// frames are read up to a limit and ignored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace unicursal::host {

/// The answer to a client's Sec-WebSocket-Key.
std::string accept_key(const std::string& key);
/// Whether a key is sixteen bytes in base 64.
bool is_websocket_key(const std::string& key);

struct Frame {
  enum class Kind { continuation = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };
  Kind kind = Kind::text;
  std::string payload;
};

/// A whole, unmasked frame, as a server sends it.
std::string encode(const Frame& frame);
std::string close_frame(std::uint16_t code);

/// The code of a close frame; absent if it has none. Throws WebSocketError for a code or a reason that RFC
/// 6455 (7.4) does not allow.
std::optional<std::uint16_t> close_code(const Frame& frame);

/// The client has broken the protocol; holds the code to close with.
class WebSocketError : public std::runtime_error {
 public:
  WebSocketError(std::uint16_t code, const char* what) : std::runtime_error(what), code_(code) {}
  std::uint16_t code() const { return code_; }

 private:
  std::uint16_t code_;
};

class FrameReader {
 public:
  static constexpr std::size_t longest_payload = 1024;  ///< bytes of a message; no client needs more

  void add(std::string_view bytes) { buffer_ += bytes; }
  /// The next whole frame; messages in pieces and texts are checked on the way. Throws WebSocketError.
  std::optional<Frame> next();

 private:
  void follow_message(const Frame& frame, bool whole);

  std::string buffer_;
  bool in_message_ = false;  ///< its last piece has not come
  bool is_text_ = false;
  std::string message_;
};

}  // namespace unicursal::host
