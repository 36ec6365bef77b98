#include "host/http/websocket.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "core/text/utf8.hpp"

namespace unicursal::host {
namespace {

constexpr const char* handshake_suffix = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";  // RFC 6455, 1.3
constexpr std::uint16_t protocol_error = 1002, bad_text = 1007, too_big = 1009;

using Digest = std::array<std::uint32_t, 5>;

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

void digest_block(const std::string& bytes, std::size_t at, Digest& digest) {
  std::array<std::uint32_t, 80> w{};
  for (std::size_t i = 0; i < 16; ++i) w[i] = word_at(bytes, at + 4 * i);
  for (std::size_t i = 16; i < 80; ++i) w[i] = std::rotl(w[i - 3] ^ w[i - 8] ^ w[i - 14] ^ w[i - 16], 1);
  auto [a, b, c, d, e] = digest;
  for (std::size_t i = 0; i < 80; ++i) {
    std::uint32_t f = b ^ c ^ d, k = 0x6ed9eba1;
    if (i < 20) {
      f = (b & c) | (~b & d);
      k = 0x5a827999;
    } else if (i >= 60) {
      k = 0xca62c1d6;
    } else if (i >= 40) {
      f = (b & c) | (b & d) | (c & d);
      k = 0x8f1bbcdc;
    }
    const std::uint32_t next = std::rotl(a, 5) + f + e + k + w[i];
    e = d;
    d = c;
    c = std::rotl(b, 30);
    b = a;
    a = next;
  }
  const Digest sum = {a, b, c, d, e};
  for (std::size_t i = 0; i < 5; ++i) digest[i] += sum[i];
}

/// SHA-1, as the handshake requires; nothing here depends on its strength.
std::string sha1(std::string text) {
  const std::uint64_t bits = text.size() * 8;
  text += '\x80';
  while (text.size() % 64 != 56) text += '\0';
  for (int shift = 56; shift >= 0; shift -= 8) text += static_cast<char>(bits >> shift & 0xff);
  Digest digest = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476, 0xc3d2e1f0};
  for (std::size_t at = 0; at < text.size(); at += 64) digest_block(text, at, digest);
  std::string bytes;
  for (const std::uint32_t word : digest) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift & 0xff);
  }
  return bytes;
}

constexpr std::string_view base64_signs = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string base64(const std::string& bytes) {
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t triple = 0;
    for (std::size_t i = 0; i < 3; ++i)
      triple = triple << 8 | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i)
      text += at + i <= bytes.size() ? base64_signs[triple >> (18 - 6 * i) & 0x3f] : '=';
  }
  return text;
}

}  // namespace

std::string accept_key(const std::string& key) {
  return base64(sha1(key + handshake_suffix));
}

bool is_websocket_key(const std::string& key) {
  return key.size() == 24 && key.ends_with("==") &&
         std::string_view(key).substr(0, 22).find_first_not_of(base64_signs) == std::string_view::npos;
}

std::string encode(const Frame& frame) {
  std::string bytes(1, static_cast<char>(0x80 | static_cast<int>(frame.kind)));
  const std::size_t size = frame.payload.size();
  const int more = size < 126 ? 0 : size < 65536 ? 2 : 8;
  bytes += static_cast<char>(more == 0 ? size : more == 2 ? 126 : 127);
  for (int shift = 8 * (more - 1); shift >= 0; shift -= 8)
    bytes += static_cast<char>(static_cast<std::uint64_t>(size) >> shift & 0xff);
  return bytes + frame.payload;
}

std::string close_frame(std::uint16_t code) {
  return encode({Frame::Kind::close, {static_cast<char>(code >> 8), static_cast<char>(code & 0xff)}});
}

std::optional<std::uint16_t> close_code(const Frame& frame) {
  const std::string& payload = frame.payload;
  if (payload.empty()) return std::nullopt;
  if (payload.size() == 1) throw WebSocketError(protocol_error, "half a close code");
  const auto code = static_cast<std::uint16_t>(static_cast<unsigned char>(payload[0]) << 8 |
                                               static_cast<unsigned char>(payload[1]));
  // 1004 to 1006 and 1015 are never sent; what is not assigned below 3000 must not be used.
  const bool defined = code >= 1000 && code <= 1014 && !(code >= 1004 && code <= 1006);
  if (!defined && !(code >= 3000 && code < 5000)) throw WebSocketError(protocol_error, "a wrong close code");
  if (!core::is_utf8(std::string_view(payload).substr(2)))
    throw WebSocketError(bad_text, "a reason that is not UTF-8");
  return code;
}

/// Holds the pieces of messages against RFC 6455 (5.4, 8.1); control frames may come between them.
void FrameReader::follow_message(const Frame& frame, bool whole) {
  if (frame.kind == Frame::Kind::close) close_code(frame);
  if (static_cast<int>(frame.kind) >= 8) return;
  const bool continues = frame.kind == Frame::Kind::continuation;
  if (continues != in_message_) throw WebSocketError(protocol_error, "a piece of another message");
  if (!continues) is_text_ = frame.kind == Frame::Kind::text;
  if (message_.size() + frame.payload.size() > longest_payload)
    throw WebSocketError(too_big, "a message that is too long");
  message_ += frame.payload;
  in_message_ = !whole;
  if (!whole) return;
  if (is_text_ && !core::is_utf8(message_)) throw WebSocketError(bad_text, "a text that is not UTF-8");
  message_.clear();
}

std::optional<Frame> FrameReader::next() {
  if (buffer_.size() < 2) return std::nullopt;
  const auto byte = [this](std::size_t at) { return static_cast<unsigned char>(buffer_[at]); };
  const int kind = byte(0) & 0x0f;
  const bool whole = (byte(0) & 0x80) != 0, control = kind >= 8;
  if ((byte(0) & 0x70) != 0 || (kind > 2 && kind < 8) || kind > 10 || (control && !whole))
    throw WebSocketError(protocol_error, "a frame of an unknown kind");
  if ((byte(1) & 0x80) == 0) throw WebSocketError(protocol_error, "a client's frames are masked");
  std::size_t size = byte(1) & 0x7f, head = 2;
  if (control && size > 125) throw WebSocketError(protocol_error, "a control frame that is too long");
  if (size == 127) throw WebSocketError(too_big, "a frame that is too long");
  if (size == 126) {
    if (buffer_.size() < 4) return std::nullopt;
    size = static_cast<std::size_t>(byte(2)) << 8 | byte(3);
    if (size < 126)
      throw WebSocketError(protocol_error, "a length that is not the shortest");  // RFC 6455, 5.2
    head = 4;
  }
  if (size > longest_payload) throw WebSocketError(too_big, "a frame that is too long");
  if (buffer_.size() < head + 4 + size) return std::nullopt;
  Frame frame{static_cast<Frame::Kind>(kind), buffer_.substr(head + 4, size)};
  for (std::size_t i = 0; i < size; ++i)
    frame.payload[i] = static_cast<char>(frame.payload[i] ^ buffer_[head + i % 4]);
  buffer_.erase(0, head + 4 + size);
  follow_message(frame, whole);
  return frame;
}

}  // namespace unicursal::host
