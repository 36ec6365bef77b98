// Sessions of browsers: how a page logs in, what its cookie opens, and when it ends.
#include <catch2/catch.hpp>

#include "host/daemon/logins.hpp"
#include "host/daemon/wrong_tries.hpp"
#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using namespace std::chrono_literals;
using test::DaemonBench;
using test::status_of;

namespace {

std::string value_in(const std::string& answer, const std::string& header) {
  const std::size_t at = answer.find("\r\n" + header + ": "), begin = at + header.size() + 4;
  return at == std::string::npos ? "" : answer.substr(begin, answer.find("\r\n", begin) - begin);
}

nlohmann::json json_in(const std::string& answer) {
  return nlohmann::json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
}

/// Of somebody without a token. `more`: further headers, each with its line end.
std::string from_browser(const DaemonBench& bench, const std::string& method, const std::string& target,
                         const std::string& body = {}, const std::string& more = {}) {
  return bench.send(method + " " + target + " HTTP/1.1\r\nHost: " + bench.host() +
                    "\r\nConnection: close\r\n" + "Content-Type: application/json\r\n" + more +
                    "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
}

std::string login_with(const DaemonBench& bench, const std::string& token, const std::string& more = {}) {
  return from_browser(bench, "POST", "/api/login", nlohmann::json{{"token", token}}.dump(), more);
}

/// "Cookie: …" with its line end, as the browser sends it from then on.
std::string cookie_after(const std::string& login) {
  const std::string set = value_in(login, "Set-Cookie");
  return "Cookie: theme=dark; " + set.substr(0, set.find(';')) + "\r\n";
}

std::string own_origin(const DaemonBench& bench) {
  return "Origin: http://" + bench.host() + "\r\n";
}

const std::string upgrade =
    "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

/// The status of a request for events with a cookie and no token.
int events_by(const DaemonBench& bench, const std::string& headers) {
  test::RawConnection connection(bench.port());
  connection.send("GET /api/events HTTP/1.1\r\nHost: " + bench.host() + "\r\nConnection: Upgrade\r\n" +
                  upgrade + headers + "\r\n");
  return status_of(connection.read_until("\r\n\r\n"));
}

}  // namespace

TEST_CASE("a page logs in with the token or a key, and its cookie opens what that opens") {
  DaemonBench bench;
  bench.serve();
  const std::string all = login_with(bench, bench.token(), own_origin(bench));
  REQUIRE(status_of(all) == 200);
  CHECK(json_in(all) == nlohmann::json{{"version", 1}, {"name", ""}, {"right", "all"}});
  const std::string set = value_in(all, "Set-Cookie");
  CHECK(set.starts_with("unicursal-" + std::to_string(bench.port()) + "="));
  CHECK(set.find("; HttpOnly; SameSite=Strict; Path=/") != std::string::npos);
  CHECK(set.find(bench.token()) == std::string::npos);
  CHECK(set.find(';') - set.find('=') - 1 == 32);  // 128 bits
  CHECK(status_of(from_browser(bench, "GET", "/api/status", {}, cookie_after(all))) == 200);
  CHECK(status_of(from_browser(bench, "GET", "/api/keys", {}, cookie_after(all))) == 200);

  const auto made = bench.ask("POST", "/api/keys", R"({"name": "phone", "right": "watch"})");
  const std::string watch = login_with(bench, made["key"]);
  CHECK(json_in(watch)["name"] == "phone");
  CHECK(json_in(watch)["right"] == "watch");
  CHECK(status_of(from_browser(bench, "GET", "/api/status", {}, cookie_after(watch))) == 200);
  const std::string refused = from_browser(bench, "GET", "/api/keys", {}, cookie_after(watch));
  CHECK(status_of(refused) == 403);
  CHECK(json_in(refused)["code"] == "no_right");

  const std::string wrong = login_with(bench, "wrong");
  CHECK(status_of(wrong) == 401);
  CHECK(json_in(wrong)["code"] == "wrong_token");
  CHECK(value_in(wrong, "Set-Cookie").empty());
  CHECK(status_of(login_with(bench, test::read_text(bench.path("state/metrics-token")).substr(0, 64))) ==
        401);
  CHECK(status_of(login_with(bench, bench.token(), "Origin: http://evil.example\r\n")) == 403);
  CHECK(status_of(from_browser(bench, "POST", "/api/login", R"({"token": 7})")) == 400);
  CHECK(json_in(from_browser(bench, "GET", "/api/status"))["code"] == "no_token");
}

TEST_CASE("a cookie alone lets no other page's request in") {
  DaemonBench bench;
  bench.serve();
  const std::string cookie = cookie_after(login_with(bench, bench.token()));
  const auto clear = [&](const std::string& headers) {
    return status_of(from_browser(bench, "POST", "/api/bed", R"({"clear": true})", cookie + headers));
  };
  CHECK(clear(own_origin(bench)) == 202);
  CHECK(clear("") == 403);
  CHECK(clear("Origin: http://evil.example\r\n") == 403);
  CHECK(clear("Origin: null\r\n") == 403);
  CHECK(clear("Origin: http://127.0.0.1:1\r\n") == 403);  // another program of this computer
  CHECK(clear(own_origin(bench) + "Sec-Fetch-Site: same-site\r\n") == 403);
  // The token is proof enough: programs send no Origin.
  CHECK(bench.status(bench.request("POST", "/api/bed", R"({"clear": true})")) == 202);
  CHECK(events_by(bench, cookie + own_origin(bench)) == 101);
  CHECK(events_by(bench, cookie) == 403);
  CHECK(events_by(bench, cookie + "Origin: http://evil.example\r\n") == 403);
  CHECK(status_of(from_browser(bench, "GET", "/api/status", {}, cookie + "Cookie: a=b\r\n")) == 400);
}

TEST_CASE("a session ends with its logout, its key or its token") {
  DaemonBench bench;
  bench.serve();
  const auto status_by = [&](const std::string& cookie) {
    return status_of(from_browser(bench, "GET", "/api/status", {}, cookie));
  };
  const std::string cookie = cookie_after(login_with(bench, bench.token()));
  const std::string out = from_browser(bench, "POST", "/api/logout", {}, cookie + own_origin(bench));
  CHECK(status_of(out) == 200);
  CHECK(value_in(out, "Set-Cookie").find("Max-Age=0") != std::string::npos);
  CHECK(status_by(cookie) == 401);

  const auto made = bench.ask("POST", "/api/keys", R"({"name": "phone", "right": "watch"})");
  const std::string phone = cookie_after(login_with(bench, made["key"]));
  const std::string owner = cookie_after(login_with(bench, bench.token()));
  CHECK(status_by(phone) == 200);
  // The page that removes a key gets its answer, although all clients of the network are let go.
  CHECK(bench.ask("DELETE", "/api/keys/" + std::to_string(made["id"].get<int>()))["removed"] == made["id"]);
  CHECK(status_by(phone) == 401);
  CHECK(status_by(owner) == 200);
  CHECK(bench.command({"token", "--renew"}).code == 0);
  CHECK(status_by(owner) == 401);
}

TEST_CASE("a page that logs in again gives its old session up, and the oldest of 64 gives way") {
  DaemonBench bench;
  bench.serve();
  const std::string first = cookie_after(login_with(bench, bench.token()));
  const std::string second = cookie_after(login_with(bench, bench.token(), first));
  CHECK(status_of(from_browser(bench, "GET", "/api/status", {}, first)) == 401);
  CHECK(status_of(from_browser(bench, "GET", "/api/status", {}, second)) == 200);

  host::Logins logins;
  std::vector<std::string> sessions;
  for (std::size_t i = 0; i <= host::Logins::most; ++i) sessions.push_back(logins.open(std::to_string(i)));
  CHECK_FALSE(logins.secret_of(sessions[0]));
  CHECK(logins.secret_of(sessions[1]) == "1");
  CHECK(logins.secret_of(sessions.back()) == "64");
  CHECK_FALSE(logins.secret_of(""));
}

TEST_CASE("who tries wrong tokens waits for each answer behind the one before, and nobody else does") {
  host::WrongTries tries;
  const auto begin = host::WrongTries::Clock::now();
  for (int i = 0; i < host::WrongTries::free_tries; ++i) CHECK(tries.wait_of("a", begin) == 0ms);
  CHECK(tries.wait_of("a", begin) == 250ms);
  CHECK(tries.wait_of("a", begin) == 750ms);  // at the same time: behind the first
  CHECK(tries.wait_of("a", begin) == 1750ms);
  CHECK(tries.wait_of("b", begin) == 0ms);
  for (int i = 0; i < 20; ++i) tries.wait_of("a", begin);
  CHECK(tries.wait_of("a", begin) == 10s);
  CHECK(tries.wait_of("a", begin + 2min) == 0ms);
  // The table is bounded, and forgets whoever was silent longest.
  for (int i = 0; i < 6; ++i) tries.wait_of("old", begin + 2min);
  for (std::size_t i = 0; i < host::WrongTries::most_peers; ++i)
    tries.wait_of(std::to_string(i), begin + 2min + std::chrono::milliseconds(i + 1));
  CHECK(tries.wait_of("old", begin + 2min + 1s) == 0ms);
}

TEST_CASE("wrong tokens wait, and the right one is heard meanwhile") {
  DaemonBench bench;
  bench.serve();
  const std::string wrong = test::replaced(bench.request("GET", "/api/status"), bench.token(), "wrong");
  for (int i = 0; i < host::WrongTries::free_tries; ++i) CHECK(bench.status(wrong) == 401);
  std::vector<std::unique_ptr<test::RawConnection>> waiting;
  for (int i = 0; i < 8; ++i) {
    waiting.push_back(std::make_unique<test::RawConnection>(bench.port()));
    waiting.back()->send(wrong);
  }
  CHECK(bench.status(bench.request("GET", "/api/status")) == 200);
  CHECK(bench.status(bench.request("POST", "/api/print/stop")) == 409);
  CHECK(status_of(waiting.front()->read_until("\r\n\r\n")) == 401);
}
