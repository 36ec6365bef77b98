// OctoPrint's push channel and its words for heat and speed, against the real daemon and a simulated printer,
// as managers of many printers and Home Assistant use them.
#include <catch2/catch.hpp>

#include "tests/host/support/slicer_bench.hpp"
#include "tests/host/support/websocket_client.hpp"

using namespace unicursal;
using nlohmann::json;
using test::SlicerBench;
using test::WebSocketClient;

namespace {

constexpr const char* push = "/sockjs/websocket";

/// The next message of this kind; others are passed over.
json next_of(WebSocketClient& client, const std::string& kind) {
  while (const auto message = client.next()) {
    if (message->contains(kind)) return message->at(kind);
  }
  FAIL("the daemon has closed");
  return {};
}

/// What has happened, up to and with this event.
std::vector<std::string> events_until(WebSocketClient& client, const std::string& last) {
  std::vector<std::string> types;
  do types.push_back(next_of(client, "event")["type"]);
  while (types.back() != last);
  std::erase(types, "PrinterStateChanged");
  return types;
}

}  // namespace

TEST_CASE("a manager of printers logs in, follows a print and its events, and steers it") {
  SlicerBench bench;
  bench.start_printer("100");
  const std::string key = bench.key_named("manager", "steer");
  const json login = bench.post("/api/login", R"({"passive": true})", key).body();
  CHECK(login["needs"]["group"] == json::array({"users"}));  // FDM Monster reads it
  const std::string auth =
      json{{"auth", login["name"].get<std::string>() + ":" + login["session"].get<std::string>()}}.dump();

  WebSocketClient client(bench.port(), push);
  REQUIRE(client.status() == 101);
  CHECK(next_of(client, "connected")["version"] == bench.get("/api/version").body()["server"]);
  client.say(auth);
  client.say(R"({"throttle": 1})");
  client.say("not JSON");
  CHECK(client.next()->contains("history"));
  CHECK(next_of(client, "current")["state"]["text"] == "Operational");

  bench.folder().write("own.svg", test::sample_drawing);
  REQUIRE(bench.slic3r(bench.path("own.svg"), "own.svg").status == 201);
  CHECK(next_of(client, "current")["job"]["file"]["name"] == "own.svg");
  REQUIRE(bench.post("/api/job", R"({"command": "start"})", key).status == 204);
  CHECK(events_until(client, "PrintStarted") == std::vector<std::string>{"PrintStarted"});
  bench.await_laying();
  const auto steer = [&](const std::string& what, const std::string& body) {
    return bench.post("/api/printer/" + what, body, key).status;
  };
  CHECK(steer("tool", R"({"command": "target", "targets": {"tool0": 207}})") == 204);
  // Home Assistant's library writes the address of the bed with two slashes, and always sends an offset.
  CHECK(bench.post("//api/printer/bed", R"({"command": "target", "target": 57, "offset": 0})", key).status ==
        204);
  CHECK(steer("tool", R"({"command": "flowrate", "factor": 95})") == 204);
  CHECK(steer("printhead", R"({"command": "feedrate", "factor": 1.5})") == 204);
  CHECK(steer("tool", R"({"command": "select", "tool": "tool0"})") == 204);
  CHECK(steer("tool", R"({"command": "target", "targets": {"tool1": 207}})") == 400);
  CHECK(steer("tool", R"({"command": "target", "targets": {"tool0": "hot"}})") == 400);
  CHECK(steer("tool", R"({"command": "target", "targets": {"tool0": 900}})") == 409);
  CHECK(steer("tool", R"({"command": "extrude", "amount": 5})") == 409);
  CHECK(steer("bed", R"({"command": "offset", "offset": 5})") == 409);
  CHECK(steer("printhead", R"({"command": "jog", "x": 5})") == 409);
  CHECK(steer("printhead", R"({"command": "feedrate"})") == 400);
  CHECK(steer("command", R"({"command": "M104 S250"})") == 409);
  // A heater follows after a while; its target is known at once.
  while (next_of(client, "current")["temps"][0]["bed"]["target"] != 57) {
  }
  CHECK(bench.get("/api/printer/tool").body()["tool0"]["target"] == 207);
  CHECK(bench.get("/api/printer/bed").body()["bed"]["target"] == 57);

  CHECK(bench.post("/api/job", R"({"command": "pause"})", key).status == 204);
  bench.await_print("paused");
  CHECK(bench.post("/api/job", R"({"command": "pause"})", key).status == 204);
  CHECK(events_until(client, "PrintResumed") == std::vector<std::string>{"PrintPaused", "PrintResumed"});
  CHECK(steer("command", R"({"command": "M112"})") == 204);
  CHECK(events_until(client, "PrintFailed") == std::vector<std::string>{"PrintFailed"});
  const std::string lines = bench.transcript();
  for (const char* line : {"M104 S207", "M140 S57", "M221 S95", "M220 S150"}) {
    CAPTURE(line);
    CHECK(lines.find(line) != std::string::npos);
  }
  CHECK(lines.find("S250") == std::string::npos);
}

TEST_CASE("who only watches may follow, and cannot set heat") {
  SlicerBench bench;
  const std::string key = bench.key_named("display", "watch");
  CHECK(bench.post("/api/printer/tool", R"({"command": "target", "targets": {"tool0": 250}})", key).status ==
        403);
  CHECK(bench.post("/api/printer/command", R"({"command": "M112"})", key).status == 403);
  CHECK(bench.get("/api/printer/bed").body() == json::object());  // nobody knows
  WebSocketClient client(bench.port(), push, "X-Api-Key: " + key + "\r\n");
  REQUIRE(client.status() == 101);
  next_of(client, "history");  // its key was in the request
}

TEST_CASE("whoever shows no right on the push channel learns nothing and is let go") {
  SlicerBench bench;
  CHECK(WebSocketClient(bench.port(), push, "X-Api-Key: wrong\r\n").status() == 403);
  CHECK(WebSocketClient(bench.port(), push, "Origin: http://evil.example\r\n").status() == 403);
  CHECK(bench.curl("", push).status == 426);
  const std::string key = bench.key_named("manager", "steer");
  const std::string session = bench.post("/api/login", "{}", key).body()["session"];
  REQUIRE(session.size() == 64);

  SECTION("a session that nobody has opened, and one of a key that was removed") {
    WebSocketClient client(bench.port(), push);
    client.say(R"({"auth": "manager:)" + std::string(64, '0') + "\"}");
    CHECK(next_of(client, "reauthRequired")["reason"] == "stale");
    REQUIRE(bench.command({"keys", "--remove", "2"}).code == 0);
    WebSocketClient late(bench.port(), push);
    late.say(R"({"auth": "manager:)" + session + "\"}");
    CHECK(next_of(late, "reauthRequired")["reason"] == "stale");
  }
  SECTION("many that say nothing take no place of those who have a key") {
    std::vector<std::unique_ptr<WebSocketClient>> silent;
    for (int i = 0; i < 70; ++i) silent.push_back(std::make_unique<WebSocketClient>(bench.port(), push));
    CHECK(silent.front()->next()->contains("connected"));
    CHECK_FALSE(silent.front()->next());  // the oldest gives way
    WebSocketClient client(bench.port(), push);
    client.say(R"({"auth": "manager:)" + session + "\"}");
    next_of(client, "history");
    CHECK(bench.get("/api/version").status == 200);
  }
}

TEST_CASE("a client that does not authenticate is let go after some seconds", "[long]") {
  SlicerBench bench;
  WebSocketClient client(bench.port(), push);
  CHECK(client.next()->contains("connected"));
  CHECK_FALSE(client.next());
  CHECK(client.closed_with() == 1008);
}
