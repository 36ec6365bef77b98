// What a page asks the daemon about a print that goes on.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/host/support/daemon_process.hpp"
#include "tests/host/support/websocket_client.hpp"

using namespace unicursal;
using test::DaemonBench;
using test::WebSocketClient;

TEST_CASE("a page sees the line, the nozzle and the heat of a print, and odd requests are refused") {
  DaemonBench bench;
  bench.start_printer("100");
  bench.serve();
  const auto status = [&](const std::string& target) { return bench.status(bench.request("GET", target)); };
  CHECK(status("/api/print/layers") == 409);
  CHECK(status("/api/print/position") == 409);
  CHECK(status("/api/print/layers/0/path") == 409);
  bench.ask("POST", "/api/jobs", R"({"job": "plate.toml"})");
  bench.ask("POST", "/api/print/start");
  bench.await_laying();
  test::await([&] { return bench.ask("GET", "/api/print/position").contains("layer"); }, bench.daemon());

  WebSocketClient events(bench.port(), "/api/events", "Authorization: Bearer " + bench.token() + "\r\n");
  REQUIRE(events.status() == 101);
  bool position = false, layer = false, progress = false;
  while (!position || !layer || !progress) {
    const auto event = events.next();
    REQUIRE(event);
    const std::string kind = event->value("event", "");
    progress = progress || (kind == "progress" && event->contains("status"));
    layer = layer || (kind == "layer" && event->at("beads").is_number_unsigned());
    if (kind != "position") continue;
    position = true;
    CHECK(event->at("at").size() == 2);
    CHECK(event->at("fed").at("shares").size() == 3);
    double sum = 0;
    for (const auto& share : event->at("leaving").at("shares")) sum += share.get<double>();
    CHECK(sum == Approx(1).margin(0.01));
  }

  const auto layers = bench.ask("GET", "/api/print/layers");
  CHECK(layers["layers"] == 2000);
  CHECK(layers["filaments"].size() == 3);
  CHECK(layers["mixtures"].size() == 2);
  REQUIRE(!layers["known"].empty());
  CHECK(layers["known"][0]["layer"] == 0);
  const std::string path = bench.send(bench.request("GET", "/api/print/layers/0/path"));
  CHECK(path.find("application/octet-stream") != std::string::npos);
  CHECK(path.substr(path.find("\r\n\r\n") + 4, 4) == "UCL1");
  CHECK(status("/api/print/layers/0/path?from=1") == 200);
  CHECK(status("/api/print/layers/0/path?from=9999999") == 422);
  CHECK(status("/api/print/layers/0/path?from=-1") == 400);
  CHECK(status("/api/print/layers/0/path?from=1e3") == 400);
  CHECK(status("/api/print/layers/0/path?from=1&from=2") == 400);
  CHECK(status("/api/print/layers/0/path?to=1") == 400);
  CHECK(status("/api/print/layers/99/path") == 404);
  CHECK(status("/api/print/layers/-1/path") == 404);
  CHECK(status("/api/print/layers/99999999999999999999999/path") == 404);
  CHECK(status("/api/print/layers/0/picture") == 404);
  CHECK(status("/api/print/layers/-1/plan") == 404);
  const auto plan_of = [&](const std::string& of) {
    const std::string plan = bench.send(bench.request("GET", "/api/print/layers/" + of + "/plan"));
    return plan.substr(plan.find("\r\n\r\n") + 4);
  };
  CHECK(plan_of("99999").size() == 32);
  test::await(  // the layer that grows still has its plan
      [&] {
        const auto now = bench.ask("GET", "/api/print/layers")["known"];
        return std::any_of(now.begin(), now.end(), [&](const auto& one) {
          return one["complete"] == false && one["planned"] == false &&
                 plan_of(one["layer"].dump()).size() > 32;
        });
      },
      bench.daemon());

  const auto heat = bench.ask("GET", "/api/temperatures");
  CHECK(heat["columns"] == nlohmann::json({"time", "nozzle", "nozzle_target", "bed", "bed_target"}));
  REQUIRE(!heat["rows"].empty());
  CHECK(heat["rows"].back().size() == 5);
  CHECK(heat["rows"].back()[1].get<double>() > 150);
  CHECK(bench
            .ask("GET",
                 "/api/temperatures?since=" + std::to_string(heat["now"].get<std::int64_t>() + 100))["rows"]
            .empty());
  CHECK(status("/api/temperatures?since=soon") == 400);

  const auto log = bench.ask("GET", "/api/log");
  REQUIRE(log["lines"].size() > 2);
  const auto next = log["next"].get<std::uint64_t>();
  CHECK(log["lines"].back()["id"] == next - 1);
  const auto later = bench.ask("GET", "/api/log?since=" + std::to_string(next));
  for (const auto& line : later["lines"]) CHECK(line["id"] >= next);
  CHECK(status("/api/log?since=-1") == 400);
}

TEST_CASE("a page sees the layers that are planned while the printer heats, and none of them as laid") {
  DaemonBench bench;
  bench.start_printer("1");  // minutes until it is hot
  bench.serve();
  WebSocketClient events(bench.port(), "/api/events", "Authorization: Bearer " + bench.token() + "\r\n");
  bench.ask("POST", "/api/jobs", R"({"job": "plate.toml"})");
  bench.ask("POST", "/api/print/start");
  nlohmann::json known;
  const auto planned = [&] {
    known = bench.ask("GET", "/api/print/layers").value("known", nlohmann::json::array());
    return known.size() > 1;
  };
  test::await(planned, bench.daemon());
  for (std::size_t i = 0; i < known.size(); ++i) {
    CHECK(known[i]["layer"] == i);
    CHECK(known[i]["planned"] == true);
    CHECK(known[i]["complete"] == false);
    CHECK(known[i]["beads"] > 20);
  }
  const std::string answer = bench.send(bench.request("GET", "/api/print/layers/1/path"));
  const std::string path = answer.substr(answer.find("\r\n\r\n") + 4);
  REQUIRE(path.size() == 32 + 9 * known[1]["beads"].get<std::size_t>());
  CHECK(path[28] == 2);  // planned only
  const std::string plan = bench.send(bench.request("GET", "/api/print/layers/1/plan"));
  CHECK(plan.substr(plan.find("\r\n\r\n") + 4) == path);
  CHECK_FALSE(bench.ask("GET", "/api/print/position").contains("layer"));
  for (bool shown = false; !shown;) {
    const auto event = events.next();
    REQUIRE(event);
    shown = event->value("event", "") == "layer" && event->at("planned") == true;
  }
  bench.await_print("heating");
  const auto asked = [&] { return bench.ask("GET", "/api/status")["print"]["nozzle"].value("job_c", 0); };
  test::await([&] { return asked() > 0; }, bench.daemon());
  CHECK(asked() == 210);
  bench.ask("POST", "/api/temperature", R"({"nozzle_c": 220})");
  CHECK(asked() == 210);
  bench.ask("POST", "/api/print/stop");
}
