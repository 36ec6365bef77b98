// Hostile requests over real sockets to a real daemon: each gets a 4xx, and nothing is opened.
#include <catch2/catch.hpp>

#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using test::DaemonBench;
using test::RawConnection;
using test::status_of;

namespace {

std::string upgrade(const DaemonBench& bench) {
  return test::replaced(bench.request("GET", "/api/events"), "Connection: close",
                        "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==");
}

/// Seconds that `work` takes.
template <class Work>
double timed(Work work) {
  const auto begun = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

}  // namespace

TEST_CASE("hostile requests are refused, and the daemon continues to serve") {
  DaemonBench bench;
  bench.serve();
  REQUIRE(bench.status(bench.request("GET", "/api/status")) == 200);
  const std::string host = "Host: " + bench.host() + "\r\n";

  SECTION("without the token, or with another") {
    CHECK(bench.status("GET /api/status HTTP/1.1\r\n" + host + "\r\n") == 401);
    CHECK(bench.status("GET /api/status HTTP/1.1\r\n" + host + "Authorization: Bearer x\r\n\r\n") == 401);
    CHECK(bench.status("GET /metrics HTTP/1.1\r\n" + host + "\r\n") == 401);
    CHECK(bench.status("GET /api/events HTTP/1.1\r\n" + host +
                       "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                       "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n") == 401);
  }
  SECTION("the body of an unknown client is not read") {
    RawConnection stranger(bench.port());
    stranger.send("PUT /api/files/a/b HTTP/1.1\r\n" + host + "Content-Length: 1000000\r\n\r\n");
    CHECK(status_of(stranger.read_until("\r\n\r\n")) == 401);
  }
  SECTION("with a header twice, so that the body would become the next request") {
    const std::string inner = "5\r\nhello\r\n0\r\n\r\n" + bench.request("GET", "/api/printer");
    RawConnection smuggler(bench.port());
    smuggler.send("POST /api/flow HTTP/1.1\r\n" + host + "Authorization: Bearer " + bench.token() +
                  "\r\nTransfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n\r\n" + inner);
    smuggler.finish_sending();
    const std::string answer = smuggler.read_all();
    CHECK(status_of(answer) == 400);
    CHECK(answer.find("HTTP/1.1 ", 9) == std::string::npos);  // one answer only
    CHECK(bench.status(bench.request("GET", "/api/status", "", "Connection: keep-alive\r\n")) == 400);
    const std::string site = "Sec-Fetch-Site: cross-site\r\n";
    CHECK(bench.status(bench.request("GET", "/api/status", "", site + site)) == 400);
  }
  SECTION("from other sites") {
    CHECK(bench.status(bench.request("POST", "/api/print/start", "", "Origin: http://evil.example\r\n")) ==
          403);
    CHECK(bench.status(bench.request("GET", "/api/status", "", "Sec-Fetch-Site: cross-site\r\n")) == 403);
    CHECK(bench.status("GET /api/status HTTP/1.1\r\nHost: evil.example\r\nAuthorization: Bearer " +
                       bench.token() + "\r\n\r\n") == 421);
    const std::string form = test::replaced(bench.request("POST", "/api/jobs", "{\"job\": \"plate.toml\"}"),
                                            "application/json", "text/plain");
    CHECK(bench.status(form) == 415);
  }
  SECTION("for files outside the folders of jobs") {
    for (const char* target : {"/../../etc/passwd", "/api/files/../../secret.toml", "/api/%2e%2e/x"})
      CHECK(bench.status(bench.request("GET", target)) == 400);
    CHECK(bench.status(bench.request("PUT", "/api/files/a/..", "x")) == 400);
    CHECK(bench.status(bench.request("PUT", "/api/files/a/.hidden", "x")) == 400);
    CHECK(bench.status(bench.request("PUT", "/api/files/a/b/c", "x")) == 400);
    for (const char* job : {"../secret.toml", "/etc/passwd", "/etc/passwd.toml", "plate.png"})
      CHECK(bench.status(bench.request("POST", "/api/jobs", "{\"job\": \"" + std::string(job) + "\"}")) ==
            400);
    CHECK(bench.status(bench.request("POST", "/api/jobs", "{\"job\": \"secret.toml\"}")) == 404);
    CHECK_FALSE(std::filesystem::exists(bench.path("state/files")));
  }
  SECTION("whose job would use up the stack") {
    std::string deep = "a";
    for (int dot = 0; dot < 500000; ++dot) deep += ".a";
    CHECK(bench.status(bench.request("PUT", "/api/files/deep/a.toml", deep + " = 1\n")) == 201);
    CHECK(bench.status(bench.request("POST", "/api/jobs", "{\"job\": \"upload:deep/a.toml\"}")) == 422);
    bench.folder().write("jobs/deep.toml", deep + " = 1\n");
    CHECK(bench.status(bench.request("POST", "/api/jobs", "{\"job\": \"deep.toml\"}")) == 422);
  }
  SECTION("too large") {
    CHECK(bench.status("POST /api/jobs HTTP/1.1\r\n" + host + "Authorization: Bearer " + bench.token() +
                       "\r\nContent-Length: 99999999999\r\n\r\n") == 413);
    CHECK(bench.status(bench.request("POST", "/api/jobs", std::string(1000000, ' '))) == 413);
    CHECK(bench.status("GET /" + std::string(5000, 'a') + " HTTP/1.1\r\n" + host + "\r\n") == 414);
    CHECK(bench.status("GET / HTTP/1.1\r\nX: " + std::string(100000, 'a') + "\r\n\r\n") == 431);
    CHECK(bench.status(std::string(1000000, 'a')) == 431);
  }
  SECTION("that are not HTTP") {
    CHECK(bench.status("\r\n\r\n") == 400);
    CHECK(bench.status(std::string("\x16\x03\x01\x02\x00\x01\x00\r\n\r\n", 11)) == 400);
    CHECK(bench.status("GET / HTTP/3.0\r\n\r\n") == 505);
    CHECK(bench.status(bench.request("BREW", "/api/status")) == 405);
    CHECK(bench.status(bench.request("POST", "/api/status")) == 405);
    CHECK(bench.status(bench.request("GET", "/api/nothing")) == 404);
    CHECK(bench.status(bench.request("GET", "/api/events")) == 426);
    for (const char* body : {"{", "[]", "7", "{\"job\": 7}", "{\"jobb\": \"plate.toml\"}", "\xff\xfe",
                             "{\"job\": \"plate.toml\", \"layers\": [-1, 2]}"})
      CHECK(bench.status(bench.request("POST", "/api/jobs", body)) == 400);
    CHECK(bench.status(bench.request("POST", "/api/jobs", std::string(60000, '['))) == 400);
    const auto nested = [&](std::size_t lists, const std::string& core) {
      return bench.send(
          bench.request("POST", "/api/jobs",
                        R"({"job": )" + std::string(lists, '[') + core + std::string(lists, ']') + "}"));
    };
    for (const std::size_t lists : {64u, 32000u}) {  // with the object one level more than is read
      CHECK(test::status_of(nested(lists, "")) == 400);
      CHECK(nested(lists, "").find("\"too_deep\"") != std::string::npos);
    }
    CHECK(nested(63, "").find("job is missing") != std::string::npos);
    CHECK(nested(0, R"("\"[[" )" + std::string(1, ' ')).find("too_deep") == std::string::npos);
    CHECK(nested(0, '"' + std::string(100, '[') + '"').find("too_deep") == std::string::npos);
    CHECK(bench.status(bench.request("DELETE", "/api/jobs/x")) == 404);
    CHECK(bench.status(bench.request("DELETE", "/api/jobs/99999999999999999999")) == 404);
  }
  SECTION("at the wrong time") {
    for (const char* word : {"pause", "resume", "cancel", "stop"})
      CHECK(bench.status(bench.request("POST", "/api/print/" + std::string(word))) == 409);
    CHECK(bench.status(bench.request("POST", "/api/print/start")) == 409);
    CHECK(bench.status(bench.request("POST", "/api/temperature", "{\"nozzle_c\": 200}")) == 409);
  }
  SECTION("cut in the middle") {
    RawConnection half(bench.port());
    half.send("POST /api/jobs HTTP/1.1\r\n" + host + "Authorization: Bearer " + bench.token() +
              "\r\nContent-Length: 100\r\n\r\n{");
    half.finish_sending();
    CHECK(status_of(half.read_all()) == 400);
  }
  SECTION("followers that leave or break the protocol are disconnected") {
    RawConnection leaves(bench.port()), breaks(bench.port());
    leaves.send(upgrade(bench));
    CHECK(leaves.read_until("\"hello\"").find(" 101 ") != std::string::npos);
    leaves.finish_sending();
    leaves.read_all();                          // ends, or the test fails
    breaks.send(upgrade(bench) + "\x81\x01z");  // not masked
    breaks.read_until("\x88\x02\x03\xea");
    breaks.finish_sending();
    breaks.read_all();
    RawConnection shouts(bench.port());  // 8 EiB are to come
    shouts.send(upgrade(bench) + std::string("\x82\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 10));
    const std::string too_big = "\x88\x02\x03\xf1";
    CHECK(shouts.read_until(too_big).ends_with(too_big));
    shouts.finish_sending();
    shouts.read_all();
  }
  SECTION("spelled in an unusual way, and still sound") {
    const std::string json = "Content-Type: application/json";
    const std::string start = bench.request("POST", "/api/flow", "{\"percent\": 90}");
    for (const char* type : {"application/json ; charset=utf-8", "Application/JSON", "application/json;"})
      CHECK(bench.status(test::replaced(start, json, "Content-Type: " + std::string(type))) == 409);
    CHECK(bench.status(test::replaced(start, json, "Content-Type: application/jsonx")) == 415);
    CHECK(bench.status(test::replaced(start, "Bearer", "bEARER")) == 409);
    const std::string got = bench.send(bench.request("GET", "/api/printer"));
    const std::string asked = bench.send(bench.request("HEAD", "/api/printer"));
    CHECK(asked == got.substr(0, got.find("\r\n\r\n") + 4));
    CHECK(bench.send(bench.request("HEAD", "/api/nothing")).ends_with("\r\n\r\n"));
    CHECK(bench.send(bench.request("PUT", "/api/jobs")).find("\r\nAllow: GET, HEAD, POST\r\n") !=
          std::string::npos);
    CHECK(bench.send(bench.request("HEAD", "/api/print/start")).find("\r\nAllow: POST\r\n") !=
          std::string::npos);
    const std::string job = "{\"job\": \"plate.toml\", \"layers\": [5, 2]}";
    CHECK(bench.status(bench.request("POST", "/api/jobs", job)) == 422);
  }
  CHECK(bench.status(bench.request("GET", "/api/status")) == 200);
  CHECK(bench.ask("GET", "/api/jobs")["jobs"].empty());
}

TEST_CASE("neither strangers nor dead followers lock out the emergency stop") {
  DaemonBench bench;
  bench.serve();
  std::vector<std::unique_ptr<RawConnection>> followers, strangers;
  for (int i = 0; i < 64; ++i) {
    followers.push_back(std::make_unique<RawConnection>(bench.port()));
    followers.back()->send(upgrade(bench));
    REQUIRE(followers.back()->read_until("\"hello\"").find(" 101 ") != std::string::npos);
  }
  CHECK(bench.status(upgrade(bench)) == 503);
  for (int i = 0; i < 500; ++i) {
    strangers.push_back(std::make_unique<RawConnection>(bench.port()));
    if (i % 2 == 0) strangers.back()->send("POST /api/print/stop HTTP/1.1\r\n");
  }
  for (int i = 0; i < 100; ++i) {
    const double seconds =
        timed([&] { CHECK(bench.status(bench.request("POST", "/api/print/stop")) == 409); });
    CHECK(seconds < 0.5);
  }
  CHECK(strangers.front()->read_all().empty());  // the oldest has given way
  CHECK(bench.status(bench.request("GET", "/api/status")) == 200);
}

TEST_CASE("a follower's connection ends with the closing of both sides") {
  DaemonBench bench;
  bench.serve();
  RawConnection client(bench.port()), stays(bench.port());
  stays.send(upgrade(bench));
  stays.read_until("\"hello\"");
  client.send(upgrade(bench));
  client.read_until("\"hello\"");
  client.send(std::string("\x88\x82\0\0\0\0\x0f\xa0", 8));  // 4000
  std::string rest;
  CHECK(timed([&] { rest = client.read_all(); }) < 5);
  CHECK(rest.ends_with("\x88\x02\x0f\xa0"));
  kill(bench.daemon().id(), SIGTERM);
  CHECK(stays.read_all().ends_with("\x88\x02\x03\xe9"));  // 1001: going away
  CHECK(bench.daemon().wait().code == 0);
}

TEST_CASE("a follower that misses two pings is let go", "[long]") {
  DaemonBench bench;
  bench.serve();
  RawConnection dead(bench.port());
  dead.send(upgrade(bench));
  dead.read_until("\"hello\"");
  dead.read_until(std::string("\x89\0", 2));
  dead.read_until(std::string("\x89\0", 2));
  CHECK(dead.read_all().find('{') == std::string::npos);  // ends
}

TEST_CASE("endless bodies and heads are given up, and others are served meanwhile", "[long]") {
  DaemonBench bench;
  bench.serve();
  RawConnection head(bench.port()), body(bench.port());
  head.send("GET /api/status HTTP/1.1\r\nX: ");
  body.send("POST /api/jobs HTTP/1.1\r\nHost: " + bench.host() + "\r\nAuthorization: Bearer " +
            bench.token() + "\r\nContent-Length: 100\r\n\r\n{");
  CHECK(bench.status(bench.request("GET", "/api/status")) == 200);
  CHECK(status_of(head.read_all()) == 408);
  CHECK(status_of(body.read_all()) == 408);
}

TEST_CASE("without a token only this computer is served") {
  DaemonBench bench;
  const auto outcome = bench.command({"serve", "--listen", "0.0.0.0:0", "--no-token"});
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("--no-token") != std::string::npos);
  bench.serve({"--no-token"});
  CHECK(bench.status("GET /api/status HTTP/1.0\r\nHost: " + bench.host() + "\r\n\r\n") == 200);
  CHECK(bench.status("GET /api/status HTTP/1.0\r\nHost: evil.example\r\n\r\n") == 421);
}
