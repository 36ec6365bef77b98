// Requests and WebSocket frames that break their protocols, with the answers that RFC 9110, 9112 and 6455 ask
// for.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace unicursal::test {

struct HostileRequest {
  const char* what;
  std::string bytes;
  std::set<int> direct;   ///< statuses that are right
  std::set<int> proxied;  ///< behind a proxy, which refuses some of them itself, or mends them
};

/// `host`: the value of Host; `token`: the daemon's.
inline std::vector<HostileRequest> hostile_requests(const std::string& host, const std::string& token) {
  const std::string known = "Host: " + host + "\r\nAuthorization: Bearer " + token + "\r\n";
  const std::string end = "Connection: close\r\n\r\n", json = "Content-Type: application/json\r\n";
  const std::string get = "GET /api/status HTTP/1.1\r\n", post = "POST /api/flow HTTP/1.1\r\n";
  const std::string inner = "GET /api/printer HTTP/1.1\r\n" + known + "\r\n";
  const std::string chunk = "5\r\nhello\r\n0\r\n\r\n";
  const auto long_of = [](std::size_t size) { return std::string(size, 'a'); };
  return {
      {"no Host", "GET /api/status HTTP/1.1\r\nAuthorization: Bearer " + token + "\r\n" + end, {400}, {400}},
      {"two Hosts", get + known + "Host: evil.example\r\n" + end, {400}, {400}},
      {"another's Host",
       get + "Host: evil.example\r\nAuthorization: Bearer " + token + "\r\n" + end,
       {421},
       {421}},
      {"no token", get + "Host: " + host + "\r\n" + end, {401}, {401}},
      {"a wrong token", get + "Host: " + host + "\r\nAuthorization: Bearer x\r\n" + end, {401}, {401}},
      {"two tokens", get + known + "Authorization: Bearer x\r\n" + end, {400}, {400}},
      {"another scheme",
       get + "Host: " + host + "\r\nAuthorization: Basic " + token + "\r\n" + end,
       {401},
       {401}},
      {"another's Origin", get + known + "Origin: http://evil.example\r\n" + end, {403}, {403}},
      {"an Origin of null", get + known + "Origin: null\r\n" + end, {403}, {403}},
      {"a cross-site fetch", get + known + "Sec-Fetch-Site: cross-site\r\n" + end, {403}, {403}},
      {"two Sec-Fetch-Sites",
       get + known + "Sec-Fetch-Site: same-origin\r\nSec-Fetch-Site: none\r\n" + end,
       {400},
       {400}},
      {"two lengths",
       post + known + json + "Content-Length: 2\r\nContent-Length: 3\r\n" + end + "{}",
       {400},
       {400}},
      {"a length and chunks",
       post + known + json + "Content-Length: 2\r\nTransfer-Encoding: chunked\r\n" + end + chunk,
       {400, 411},
       {400, 411}},
      {"chunks twice",
       post + known + json + "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n\r\n" + chunk +
           inner,
       {400},
       {400, 501}},
      {"chunks", post + known + json + "Transfer-Encoding: chunked\r\n" + end + chunk, {411}, {400}},
      {"an unknown coding",
       post + known + json + "Transfer-Encoding: identity\r\n" + end,
       {400, 411, 501},
       {501}},
      {"a negative length", post + known + json + "Content-Length: -1\r\n" + end, {400}, {400}},
      {"a length with a sign", post + known + json + "Content-Length: +2\r\n" + end + "{}", {400}, {400}},
      {"a length in hexadecimal", post + known + json + "Content-Length: 0x2\r\n" + end + "{}", {400}, {400}},
      {"a length beyond 2^64",
       post + known + json + "Content-Length: 99999999999999999999\r\n" + end,
       {400, 413},
       {400, 413}},
      {"too long a body", post + known + json + "Content-Length: 99999999\r\n" + end, {413}, {413}},
      {"a folded header", get + known + "X: a\r\n b\r\n" + end, {400}, {400}},
      {"a space before the colon", get + known + "X : a\r\n" + end, {400}, {400}},
      {"a header without a colon", get + known + "nonsense\r\n" + end, {400}, {200, 400}},
      {"a NUL in a header", get + known + "X: a" + std::string(1, '\0') + "b\r\n" + end, {400}, {400}},
      {"a lone CR in a header", get + known + "X: a\rb\r\n" + end, {400}, {400}},
      {"a control character in the target", "GET /api/sta\x01tus HTTP/1.1\r\n" + known + end, {400}, {400}},
      {"a target that leads out", "GET /api/../../etc/passwd HTTP/1.1\r\n" + known + end, {400}, {400}},
      {"an encoded way out",
       "GET /api/files/%2e%2e/%2e%2e/x HTTP/1.1\r\n" + known + end,
       {400, 404, 405},
       {400, 404, 405}},
      {"too long a target", "GET /" + long_of(20000) + " HTTP/1.1\r\n" + known + end, {414, 431}, {414}},
      {"too long a head", get + known + "X: " + long_of(40000) + "\r\n" + end, {431}, {400, 431}},
      {"a version to come", "GET /api/status HTTP/3.0\r\n" + known + end, {505}, {400, 505}},
      {"an unknown method", "BREW /api/status HTTP/1.1\r\n" + known + end, {405}, {405}},
      {"another protocol", "\x16\x03\x01\x02\r\n\r\n", {400}, {400}},
  };
}

struct BadFrame {
  const char* what;
  std::string bytes;
  int code;  ///< with which the server closes (RFC 6455, 7.4.1)
};

/// Frames of a client; the mask is 0, which is a mask.
inline std::vector<BadFrame> bad_frames() {
  const auto frame = [](int first, const std::string& content) {
    return std::string(1, static_cast<char>(first)) + static_cast<char>(0x80 | content.size()) +
           std::string(4, '\0') + content;
  };
  const auto close = [&](int code, const std::string& reason = {}) {
    return frame(0x88, std::string{static_cast<char>(code >> 8), static_cast<char>(code & 0xff)} + reason);
  };
  constexpr int protocol = 1002, not_utf8 = 1007, too_big = 1009;
  return {
      {"a frame without a mask", "\x81\x01z", protocol},
      {"a reserved bit", frame(0xc1, "z"), protocol},
      {"an unknown kind", frame(0x83, "z"), protocol},
      {"an unknown control", frame(0x8b, ""), protocol},
      {"a ping in fragments", frame(0x09, "z"), protocol},
      {"a ping that is too long", std::string("\x89\xfe\x00\x7e\0\0\0\0", 8) + std::string(126, 'z'),
       protocol},
      {"a continuation of nothing", frame(0x80, "z"), protocol},
      {"a text within a text", frame(0x01, "a") + frame(0x81, "b"), protocol},
      {"a length that is not the shortest", std::string("\x81\xfe\x00\x01\0\0\0\0z", 9), protocol},
      {"bytes that are not UTF-8", frame(0x81, "\xff"), not_utf8},
      {"8 EiB to come", std::string("\x82\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 10), too_big},
      {"a close with one byte", frame(0x88, "z"), protocol},
      {"a close with a code that may not be sent", close(1005), protocol},
  };
}

}  // namespace unicursal::test
