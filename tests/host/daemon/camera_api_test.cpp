// What the page's users choose, and the pictures of the camera that they have chosen: hostile cameras, and
// users who have not the right to choose one.
#include <catch2/catch.hpp>

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>

#include "host/daemon/camera.hpp"
#include "tests/host/support/daemon_process.hpp"
#include "tests/host/support/small_server.hpp"

using namespace unicursal;
using nlohmann::json;
using test::DaemonBench;
using test::SmallServer;

namespace {

const std::string jpeg = "\xff\xd8\xff\xe0 a picture", ok = "HTTP/1.1 200 OK\r\n";

void set_camera(const DaemonBench& bench, const std::string& address) {
  REQUIRE(bench.status(bench.request("PUT", "/api/preferences", json{{"camera", address}}.dump())) == 200);
}

/// What the daemon answers when a camera has answered this.
std::string seen_through(DaemonBench& bench, const SmallServer& camera) {
  set_camera(bench, "http://" + camera.host() + "/snap.jpg?pwd=hidden");
  return bench.send(bench.request("GET", "/api/camera"));
}

std::string with_key(const std::string& request, const DaemonBench& bench, const std::string& key) {
  return test::replaced(request, bench.token(), key);
}

}  // namespace

TEST_CASE("the daemon passes a camera's picture on, and nothing else") {
  DaemonBench bench;
  bench.serve();
  CHECK(bench.status(bench.request("GET", "/api/camera")) == 404);
  {
    const std::string length = "Content-Length: " + std::to_string(jpeg.size()) + "\r\n";
    SmallServer camera({ok + "Content-Type: text/html\r\n" + length + "\r\n" + jpeg + "more"});
    const std::string answer = seen_through(bench, camera);
    CHECK(test::status_of(answer) == 200);
    CHECK(answer.find("Content-Type: image/jpeg\r\n") != std::string::npos);  // what it is, not what it says
    CHECK(answer.ends_with("\r\n\r\n" + jpeg));
    const std::string asked = camera.requests().at(0);
    CHECK(asked.starts_with("GET /snap.jpg?pwd=hidden HTTP/1.0\r\nHost: " + camera.host() + "\r\n"));
    CHECK(asked.find(bench.token()) == std::string::npos);
  }
  {
    const std::string png = std::string("\x89PNG\r\n\x1a\n", 8) + "rest";
    const SmallServer camera({ok + "\r\n" + png});  // the end of the stream is its end
    const std::string answer = seen_through(bench, camera);
    CHECK(answer.find("Content-Type: image/png\r\n") != std::string::npos);
    CHECK(answer.ends_with("\r\n\r\n" + png));
  }
  struct Bad {
    const char* what;
    SmallServer::Answer answer;
    const char* said;
  };
  SmallServer elsewhere({ok + "\r\n" + jpeg});
  const Bad bads[] = {
      {"HTML", {ok + "\r\n<html><script>alert(1)</script>"}, "neither JPEG nor PNG"},
      {"a redirect",
       {"HTTP/1.1 302 Found\r\nLocation: http://" + elsewhere.host() + "/\r\nContent-Length: 0\r\n\r\n"},
       "another address"},
      {"100 MB that it announces",
       {ok + "Content-Length: 104857600\r\n\r\n" + jpeg, true},
       "more than 4 MiB"},
      {"a picture without an end", {ok + "\r\n" + jpeg, true}, "more than 4 MiB"},
      {"a head without an end", {ok + "X: ", true}, "not HTTP"},
      {"half a picture", {ok + "Content-Length: 1000\r\n\r\n" + jpeg}, "broken off"},
      {"a film",
       {ok + "Content-Type: multipart/x-mixed-replace; boundary=x\r\n\r\n--x", true},
       "single pictures"},
      {"a refusal", {"HTTP/1.1 401 Unauthorized\r\n\r\n"}, "status 401"},
      {"another protocol", {"SSH-2.0-x\r\n\r\n"}, "not HTTP"},
      {"no answer", {""}, "before it answered"},
      {"a length that is not one", {ok + "Content-Length: -5\r\n\r\n" + jpeg}, "not a number"}};
  for (const Bad& bad : bads) {
    INFO(bad.what);
    const SmallServer camera(bad.answer);
    const std::string answer = seen_through(bench, camera);
    CHECK(test::status_of(answer) == 502);
    CHECK(answer.find(bad.said) != std::string::npos);
    CHECK(answer.find("\"no_answer\"") != std::string::npos);
    CHECK(answer.find("hidden") == std::string::npos);
  }
  CHECK(elsewhere.requests().empty());
  set_camera(bench, "http://127.0.0.1:1/");
  CHECK(bench.status(bench.request("GET", "/api/camera")) == 502);
  CHECK(bench.daemon().err().find("hidden") == std::string::npos);
  set_camera(bench, "");
  CHECK(bench.status(bench.request("GET", "/api/camera")) == 404);
}

TEST_CASE("a camera that says nothing is left after some time") {
  const SmallServer camera({"", false, true});
  asio::io_context loop;
  int status = 0;
  asio::co_spawn(
      loop,
      [&]() -> asio::awaitable<void> {
        try {
          co_await host::fetch_picture(host::parse_camera_address("http://" + camera.host() + "/"),
                                       std::chrono::milliseconds(50));
        } catch (const host::HttpError& refused) {
          status = refused.status();
        }
      },
      [](std::exception_ptr) {});
  loop.run();
  CHECK(status == 504);
}

TEST_CASE("the address of a camera is that of a computer, without a password") {
  const auto parsed = host::parse_camera_address("HTTP://[fe80::1]:8080?a=b#c");
  CHECK(parsed.host == "fe80::1");
  CHECK(parsed.port == "8080");
  CHECK(parsed.target == "/?a=b");
  CHECK(host::parse_camera_address("http://cam").port == "80");
  for (const char* bad : {"", "https://cam/", "file:///etc/passwd", "ftp://cam/", "//cam/", "http://",
                          "http:///x", "http://:80/", "http://cam:0/", "http://cam:65536/", "http://cam:80x/",
                          "http://user:pw@cam/", "http://cam/a b", "http://cam/\r\nX: y"}) {
    INFO(bad);
    CHECK_THROWS_AS(host::parse_camera_address(bad), host::HttpError);
  }
}

TEST_CASE("preferences are kept, and only the token sets and sees a camera's whole address") {
  DaemonBench bench;
  bench.serve();
  const json before = bench.ask("GET", "/api/preferences");
  CHECK(before["name"] == "");
  CHECK(before["camera"] == "");
  CHECK(before["presets"][0] == json{{"name", "PLA"}, {"nozzle_c", 210.0}, {"bed_c", 60.0}});
  const json wanted{{"name", "Küche <b>"},
                    {"language", "de"},
                    {"camera", "http://cam/snap?pwd=hidden"},
                    {"presets", {{{"name", "PETG"}, {"nozzle_c", 240}, {"bed_c", 80.5}}}}};
  json kept = bench.ask("PUT", "/api/preferences", wanted.dump());
  kept.erase("version");
  CHECK(kept == wanted);
  const std::string steer = bench.ask("POST", "/api/keys", R"({"name": "a", "right": "steer"})")["key"];
  const std::string watch = bench.ask("POST", "/api/keys", R"({"name": "b", "right": "watch"})")["key"];
  const std::string shown = bench.send(with_key(bench.request("GET", "/api/preferences"), bench, watch));
  CHECK(shown.find("\"http://cam/snap\"") != std::string::npos);
  CHECK(shown.find("hidden") == std::string::npos);
  const auto put = [&](const json& body, const std::string& key) {
    return bench.status(with_key(bench.request("PUT", "/api/preferences", body.dump()), bench, key));
  };
  CHECK(put({{"name", "x"}}, watch) == 403);
  CHECK(put({{"camera", "http://127.0.0.1:22/"}}, steer) == 403);
  CHECK(put({{"name", "Hof"}, {"camera", "http://cam/snap"}}, steer) == 200);  // as it was shown
  kill(bench.daemon().id(), SIGKILL);
  bench.daemon().wait();
  bench.serve();
  const json after = bench.ask("GET", "/api/preferences");
  CHECK(after["name"] == "Hof");
  CHECK(after["camera"] == "http://cam/snap?pwd=hidden");
  CHECK(after["presets"] == wanted["presets"]);
}

TEST_CASE("preferences that make no sense are refused as a whole") {
  DaemonBench bench;
  bench.serve();
  const json before = bench.ask("GET", "/api/preferences");
  const json preset{{"name", "PLA"}, {"nozzle_c", 210}, {"bed_c", 60}};
  const auto with = [&](const char* key, const json& value) {
    json changed = preset;
    changed[key] = value;
    return json{{"presets", {changed}}};
  };
  const std::pair<json, int> bads[] = {{{{"names", "x"}}, 400},
                                       {{{"name", 7}}, 400},
                                       {{{"name", std::string(400, 'x')}}, 422},
                                       {{{"name", "a\nb"}}, 422},
                                       {{{"language", "../x"}}, 422},
                                       {{{"camera", "https://cam/"}}, 422},
                                       {{{"presets", preset}}, 400},
                                       {{{"presets", json::array({1})}}, 400},
                                       {{{"presets", std::vector<json>(17, preset)}}, 422},
                                       {with("nozzle_c", 451), 422},
                                       {with("nozzle_c", -1), 422},
                                       {with("bed_c", "60"), 400},
                                       {with("name", ""), 422}};
  for (const auto& [bad, status] : bads) {
    json body = bad;
    body.push_back({"language", bad.value("language", "fr")});
    INFO(body.dump());
    CHECK(bench.status(bench.request("PUT", "/api/preferences", body.dump())) == status);
  }
  CHECK(bench.ask("GET", "/api/preferences") == before);
  kill(bench.daemon().id(), SIGTERM);
  bench.daemon().wait();
  bench.folder().write("state/preferences.json", "{\"presets\": 7}");
  const test::Outcome refused =
      test::run({"serve", "--listen", "127.0.0.1:0", "--state", bench.path("state")});
  CHECK(refused.code == 2);
  CHECK(refused.err.find("preferences.json") != std::string::npos);
}
