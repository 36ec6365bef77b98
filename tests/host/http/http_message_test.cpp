// Reading of requests, frames of WebSockets, and access.
#include "host/http/http_message.hpp"

#include <catch2/catch.hpp>

#include "host/daemon/access.hpp"
#include "host/daemon/secret.hpp"
#include "host/http/websocket.hpp"

using namespace unicursal::host;

namespace {

int refused(const std::string& head) {
  try {
    parse_request(head);
  } catch (const HttpError& error) {
    return error.status();
  }
  return 200;
}

const std::string host_line = "Host: 127.0.0.1:8377";

int let_in(const std::string& headers, const AccessRules& rules, const std::string& path = "/api/status") {
  try {
    check_access(parse_request("GET " + path + " HTTP/1.1\r\n" + headers), rules);
  } catch (const HttpError& error) {
    return error.status();
  }
  return 200;
}

std::string masked(int first, const std::string& payload) {
  const std::string mask = "\x11\x22\x33\x44";
  std::string bytes{static_cast<char>(first), static_cast<char>(0x80 | static_cast<int>(payload.size()))};
  bytes += mask;
  for (std::size_t i = 0; i < payload.size(); ++i) bytes += static_cast<char>(payload[i] ^ mask[i % 4]);
  return bytes;
}

}  // namespace

TEST_CASE("a request's head is read") {
  const RequestHead head = parse_request(
      "POST /api/jobs?a=b HTTP/1.1\r\nHOST: x:1\r\nContent-Length:  12 \r\nConnection: Upgrade, close");
  CHECK(head.method == "POST");
  CHECK(head.path == "/api/jobs");
  CHECK(head.query == "a=b");
  CHECK(head.header("host") == "x:1");
  CHECK(head.content_length == 12);
  CHECK_FALSE(head.keep_alive);
  CHECK(head.lists("connection", "upgrade"));
  CHECK_FALSE(head.lists("connection", "up"));
}

TEST_CASE("ambiguous requests are refused") {
  CHECK(refused("GET / HTTP/1.1\r\nContent-Length: 3\r\nContent-Length: 4") == 400);
  CHECK(refused("GET / HTTP/1.1\r\nHost: a\r\nHost: b") == 400);
  CHECK(refused("POST / HTTP/1.1\r\nTransfer-Encoding: chunked") == 411);
  for (const char* name :
       {"Transfer-Encoding", "Content-Length", "Connection", "Sec-Fetch-Site", "Sec-WebSocket-Protocol",
        "sec-websocket-key", "Sec-WebSocket-Version", "Upgrade", "Expect", "Content-Type", "Authorization"}) {
    CAPTURE(name);
    const std::string line = "\r\n" + std::string(name) + ": 1";
    CHECK(refused("GET / HTTP/1.1" + line + "\r\nX: y" + line) == 400);
  }
  CHECK_THROWS_AS(parse_request("GET / HTTP/1.1\r\nX: a\r\nX: b").header("x"), HttpError);
  CHECK(refused("GET / HTTP/1.1\r\nContent-Length: +3") == 400);
  CHECK(refused("GET / HTTP/1.1\r\nContent-Length: 99999999999999999999999") == 413);
  CHECK(refused("GET / HTTP/1.1\r\nHost : a") == 400);
  CHECK(refused("GET / HTTP/1.1\r\nX: a\n b") == 400);
  CHECK(refused("GET / HTTP/1.1\r\n folded") == 400);
  CHECK(refused("GET / HTTP/2.0") == 505);
  CHECK(refused("GET /") == 400);
  CHECK(refused("GET http://elsewhere/ HTTP/1.1") == 400);
  CHECK(refused("GET /" + std::string(longest_target, 'a') + " HTTP/1.1") == 414);
  std::string many = "GET / HTTP/1.1";
  for (std::size_t i = 0; i <= most_headers; ++i) many += "\r\nX: y";
  CHECK(refused(many) == 431);
}

TEST_CASE("no spelling of a path leads upwards") {
  for (const char* path :
       {"/..", "/api/../x", "/api/jobs/..", "///x", "/a//b", "/./a", "/%2e%2e/x", "/a\\..\\b"})
    CHECK(refused("GET " + std::string(path) + " HTTP/1.1") == 400);
  CHECK(refused("GET /api/jobs/12 HTTP/1.1") == 200);
  CHECK(refused("GET /a..b HTTP/1.1") == 200);
}

TEST_CASE("only clients with the token and a name of this computer are let in") {
  const std::string token(64, 'a'), metrics(64, 'b');
  const AccessRules rules{token, metrics, hosts_for("127.0.0.1", 8377, {"Printer.local"})};
  const std::string bearer = "\r\nAuthorization: Bearer ";
  CHECK(let_in(host_line + bearer + token, rules) == 200);
  CHECK(let_in("Host: printer.local:8377" + bearer + token, rules) == 200);
  CHECK(let_in("X: y" + bearer + token, rules) == 400);
  CHECK(let_in("Host: evil.example:8377" + bearer + token, rules) == 421);
  CHECK(let_in("Host: 127.0.0.1:80" + bearer + token, rules) == 421);
  CHECK(let_in(host_line, rules) == 401);
  CHECK(let_in(host_line + "\r\nAuthorization: bearer  " + token, rules) == 200);
  CHECK(let_in(host_line + "\r\nAuthorization: Basic " + token, rules) == 401);
  CHECK(let_in(host_line + "\r\nAuthorization: Bearer", rules) == 401);
  CHECK(let_in(host_line + "\r\nSec-WebSocket-Protocol: xxtoken." + token, rules) == 401);
  CHECK(let_in(host_line + bearer + token.substr(1), rules) == 401);
  CHECK(let_in(host_line + bearer + metrics, rules) == 401);
  CHECK(let_in(host_line + bearer + metrics, rules, "/metrics") == 200);
  CHECK(let_in(host_line + bearer + token, rules, "/metrics") == 200);
  CHECK(let_in(host_line + "\r\nSec-WebSocket-Protocol: unicursal.v1, token." + token, rules) == 200);
  CHECK(let_in(host_line + "\r\nOrigin: http://localhost:8377" + bearer + token, rules) == 200);
  CHECK(let_in(host_line + "\r\nOrigin: http://evil.example" + bearer + token, rules) == 403);
  CHECK(let_in(host_line + "\r\nOrigin: null" + bearer + token, rules) == 403);
  CHECK(let_in(host_line + "\r\nSec-Fetch-Site: cross-site" + bearer + token, rules) == 403);
  SECTION("without a token the other rules hold") {
    const AccessRules open{{}, {}, rules.hosts};
    CHECK(let_in(host_line, open) == 200);
    CHECK(let_in("Host: evil.example", open) == 421);
    CHECK(let_in(host_line + "\r\nOrigin: http://evil.example", open) == 403);
  }
}

TEST_CASE("tokens are long and differ") {
  CHECK(random_token().size() == 64);
  CHECK(random_token() != random_token());
}

TEST_CASE("the handshake's answer is that of RFC 6455") {
  CHECK(accept_key("dGhlIHNhbXBsZSBub25jZQ==") == "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
  CHECK(is_websocket_key("dGhlIHNhbXBsZSBub25jZQ=="));
  CHECK_FALSE(is_websocket_key("dGhlIHNhbXBsZSBub25jZQ"));
  CHECK_FALSE(is_websocket_key("dGhlIHNhbXBsZSBub25j\r\n=="));
}

TEST_CASE("frames have the length that they announce") {
  for (const std::size_t size : {0u, 1u, 125u, 126u, 65535u, 65536u}) {
    const std::string bytes = encode({Frame::Kind::text, std::string(size, 'x')});
    const std::size_t head = size < 126 ? 2 : size < 65536 ? 4 : 10;
    CHECK(bytes.size() == head + size);
    CHECK(bytes[0] == '\x81');
  }
  CHECK(encode({Frame::Kind::text, std::string(300, 'x')}).substr(1, 3) == std::string("\x7e\x01\x2c", 3));
  CHECK(close_frame(1001) == std::string("\x88\x02\x03\xe9", 4));
}

TEST_CASE("a client's frames are read in pieces of any size") {
  const std::string bytes = masked(0x89, "ping") + masked(0x88, "");
  FrameReader reader;
  std::vector<Frame> frames;
  for (const char byte : bytes) {
    reader.add({&byte, 1});
    while (auto frame = reader.next()) frames.push_back(*frame);
  }
  REQUIRE(frames.size() == 2);
  CHECK(frames[0].kind == Frame::Kind::ping);
  CHECK(frames[0].payload == "ping");
  CHECK(frames[1].kind == Frame::Kind::close);
}

TEST_CASE("a client's frames that break the protocol are refused") {
  const auto code = [](const std::string& bytes) {
    FrameReader reader;
    reader.add(bytes);
    try {
      reader.next();
    } catch (const WebSocketError& error) {
      return static_cast<int>(error.code());
    }
    return 0;
  };
  CHECK(code(std::string("\x81\x01", 2) + "a") == 1002);  // not masked
  CHECK(code(masked(0x09, "")) == 1002);                  // a control frame in pieces
  CHECK(code(masked(0x83, "")) == 1002);                  // an unknown kind
  CHECK(code(masked(0xc1, "")) == 1002);                  // an extension that was not negotiated
  CHECK(code(masked(0x80, "a")) == 1002);                 // a continuation of nothing
  CHECK(code(masked(0x81, "\xff")) == 1007);              // a text that is not UTF-8
  CHECK(code(masked(0x81, "\xed\xa0\x80")) == 1007);      // a surrogate
  CHECK(code(masked(0x88, "\x03")) == 1002);              // half a close code
  for (const int wrong : {0, 999, 1004, 1005, 1006, 1015, 1016, 2999, 5000, 65535}) {
    CAPTURE(wrong);
    CHECK(code(masked(0x88, {static_cast<char>(wrong >> 8), static_cast<char>(wrong & 0xff)})) == 1002);
  }
  CHECK(code(masked(0x88, "\x03\xe8\xc3")) == 1007);  // a reason that is not UTF-8
  CHECK(code(masked(0x88, "\x03\xe8\xc3\xa4")) == 0);
  CHECK(code(masked(0x88, "\x0f\xa0")) == 0);
  CHECK(code(std::string("\x82\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 10)) == 1009);  // the greatest length
  CHECK(code(std::string("\x82\xfe\xff\xff", 4)) == 1009);
}

TEST_CASE("a client's message may come in pieces, with control frames between them") {
  const auto last_code = [](const std::string& bytes) {
    FrameReader reader;
    reader.add(bytes);
    try {
      while (reader.next()) {
      }
    } catch (const WebSocketError& error) {
      return static_cast<int>(error.code());
    }
    return 0;
  };
  CHECK(last_code(masked(0x01, "\xc3") + masked(0x89, "") + masked(0x80, "\xa4") + masked(0x81, "b")) == 0);
  CHECK(last_code(masked(0x01, "\xc3") + masked(0x80, "a")) == 1007);
  CHECK(last_code(masked(0x01, "a") + masked(0x81, "b")) == 1002);  // the first was not ended
  CHECK(last_code(masked(0x02, "\xff") + masked(0x80, "\xff")) == 0);
  std::string many = masked(0x01, "");
  for (int i = 0; i < 20; ++i) many += masked(0x00, std::string(100, 'a'));
  CHECK(last_code(many) == 1009);
}
