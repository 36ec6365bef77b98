// What the daemon says of prints that have ended, and what it does with them and with its queue.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <numbers>

#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using nlohmann::json;
using test::DaemonBench;

namespace {

int queue_job(const DaemonBench& bench, const std::string& layers = "[0, 0]") {
  const json answer = bench.ask("POST", "/api/jobs", "{\"job\": \"plate.toml\", \"layers\": " + layers + "}");
  INFO(answer.dump());
  REQUIRE(answer.contains("id"));
  return answer["id"];
}

json past_prints(const DaemonBench& bench) {
  return bench.ask("GET", "/api/history")["prints"];
}

/// The row of an ended print comes a moment later, since nothing waits for it.
json await_row(DaemonBench& bench) {
  await([&] { return !past_prints(bench).empty(); }, bench.daemon());
  const json prints = past_prints(bench);
  REQUIRE(prints.size() == 1);
  return prints[0];
}

/// The row's metres are those that the printer's feeders have turned.
void check_steps(const DaemonBench& bench, const json& print) {
  const json seen = json::parse(test::read_text(bench.path("seen.json")));
  REQUIRE(print["filaments"].size() == 3);
  for (std::size_t f = 0; f < 3; ++f) {
    INFO(print["filaments"][f].dump() << seen["feeders"][f].dump());
    const double metres = seen["feeders"][f]["mm"].get<double>() / 1000;
    CHECK(print["filaments"][f]["metres"].get<double>() == Approx(metres).epsilon(0.005));
    CHECK(print["filaments"][f]["grams"].get<double>() ==
          Approx(metres * std::numbers::pi / 4 * 1.75 * 1.75 * 1.24).epsilon(0.005));
  }
}

std::vector<std::string> reporting(const DaemonBench& bench, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"--report", bench.path("seen.json")};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::vector<int> order_of(const DaemonBench& bench) {
  std::vector<int> ids;
  const json jobs = bench.ask("GET", "/api/jobs")["jobs"];
  for (const json& job : jobs) ids.push_back(job["id"]);
  return ids;
}

}  // namespace

TEST_CASE("a print of the daemon is in its history with picture, note and table, and is printed again") {
  DaemonBench bench;
  bench.start_printer("0", reporting(bench));
  bench.serve();
  CHECK(past_prints(bench).empty());
  const int id = queue_job(bench);
  bench.ask("POST", "/api/print/start", "{}");
  bench.await_job(id, "done");
  const json print = await_row(bench);
  INFO(print.dump());
  CHECK(print["job"] == "plate");
  CHECK(print["ended"] == "completed");
  CHECK(print["layers_done"] == 1);
  CHECK(print["can_resume"] == false);
  CHECK(print["foretold_seconds"].get<double>() > 10);
  CHECK(print["picture"] == true);
  const std::string row = "/api/history/" + std::to_string(print["id"].get<int>());
  const std::string picture = bench.send(bench.request("GET", row + "/picture"));
  CHECK(picture.find("Content-Type: image/png\r\n") != std::string::npos);
  CHECK(picture.find("\r\n\r\n\x89PNG") != std::string::npos);
  CHECK(bench.ask("PUT", row, R"({"note": "<b>warped</b>"})")["id"] == print["id"]);
  CHECK(past_prints(bench)[0]["note"] == "<b>warped</b>");
  CHECK(bench.status(bench.request("PUT", row, "{\"note\": \"" + std::string(5000, 'x') + "\"}")) == 422);
  CHECK(bench.send(bench.request("GET", "/api/history.csv")).find(",<b>warped</b>\r\n") != std::string::npos);
  CHECK(bench.ask("GET", "/api/history?before=1")["prints"].empty());
  CHECK(bench.ask("GET", "/api/history?limit=0")["prints"].empty());
  CHECK(bench.status(bench.request("GET", "/api/history?limit=x")) == 400);
  const json again = bench.ask("POST", row + "/again", "{}");
  CHECK(bench.ask("GET", "/api/jobs/" + std::to_string(again["id"].get<int>()))["layers"] == json({0, 0}));
  std::filesystem::remove(bench.path("jobs/plate.toml"));
  CHECK(bench.status(bench.request("POST", row + "/again", "{}")) == 404);
  CHECK(bench.ask("GET", "/api/history")["totals"]["prints"] == 1);
  CHECK(bench.status(bench.request("DELETE", row)) == 200);
  CHECK(bench.status(bench.request("DELETE", row)) == 404);
  CHECK(past_prints(bench).empty());
  bench.transcript();
  check_steps(bench, print);
}

TEST_CASE("a print goes on while the disk has no room for its history, and its row comes later",
          "[optimised]") {
  DaemonBench bench;
  bench.start_printer("0");
  bench.serve();
  const auto print = [&] {
    const int id = queue_job(bench);
    bench.ask("POST", "/api/print/start", "{}");
    bench.await_job(id, "done");
  };
  print();
  await_row(bench);
  // What a print keeps of itself has room; the table, which is the largest file, cannot grow.
  const rlimit full{std::filesystem::file_size(bench.path("spool/history.db")), RLIM_INFINITY};
  const rlimit room{RLIM_INFINITY, RLIM_INFINITY};
  REQUIRE(prlimit(bench.daemon().id(), RLIMIT_FSIZE, &full, nullptr) == 0);
  print();
  await([&] { return bench.ask("GET", "/api/status").contains("problem"); }, bench.daemon());
  const std::string problem = bench.ask("GET", "/api/status")["problem"];
  CHECK(problem.find("the history of prints cannot be written") != std::string::npos);
  CHECK(problem.find("is added to it later") != std::string::npos);
  CHECK(bench.ask("GET", "/api/log").dump().find("history of prints cannot be written") != std::string::npos);
  REQUIRE(prlimit(bench.daemon().id(), RLIMIT_FSIZE, &room, nullptr) == 0);
  print();
  await([&] { return !bench.ask("GET", "/api/status").contains("problem"); }, bench.daemon());
  await([&] { return past_prints(bench).size() == 3; }, bench.daemon());
  CHECK(bench.ask("GET", "/api/history")["totals"]["prints"] == 3);
}

TEST_CASE("a print that was stopped is one row with what was fed for it", "[optimised]") {
  DaemonBench bench;
  bench.start_printer("100", reporting(bench));
  bench.serve();
  const int id = queue_job(bench, "[0, 9]");
  bench.ask("POST", "/api/print/start", "{}");
  await([&] { return bench.ask("GET", "/api/status").value("/print/layer"_json_pointer, 0) > 1; },
        bench.daemon());
  bench.ask("POST", "/api/print/cancel", "{}");
  bench.await_job(id, "stopped");
  const json print = await_row(bench);
  INFO(print.dump());
  CHECK(print["ended"] == "stopped");
  CHECK(print["reason"] == "the user has stopped it");
  CHECK(print["layers_done"] >= 1);
  CHECK(print["layers_done"] < 10);
  CHECK(print["layers"] == 10);
  bench.transcript();
  check_steps(bench, print);
}

TEST_CASE(
    "a print whose cable was pulled fails as one row, and is continued by its name after saying what it will "
    "do",
    "[optimised]") {
  DaemonBench bench;
  bench.start_printer("100", reporting(bench, {"--fault", "disconnect:5@line=400"}));
  bench.serve();
  const int id = queue_job(bench, "[0, 4]");
  bench.ask("POST", "/api/print/start", "{}");
  await([&] { return bench.ask("GET", "/api/status")["state"] == "reconnecting"; }, bench.daemon());
  bench.ask("POST", "/api/print/cancel", "{}");
  await([&] { return bench.ask("GET", "/api/status")["state"] == "idle"; }, bench.daemon());
  const json failed = await_row(bench);
  INFO(failed.dump());
  const json kept = bench.ask("GET", "/api/prints")["prints"];
  REQUIRE(kept.size() == 1);
  CHECK(kept[0]["layers"] == 5);
  if (failed["ended"] == "failed") {
    CHECK(failed["reason"].get<std::string>().find("cable") != std::string::npos);
    CHECK(failed["can_resume"] == true);
    CHECK(kept[0]["may_resume"] == true);
    await([&] { return std::filesystem::exists(bench.path("port")); }, bench.daemon());
    const std::string name = kept[0]["name"], address = "/api/prints/" + name + "/resume";
    const json will = bench.ask("POST", address, "{}");
    INFO(will.dump());
    CHECK(will["will"].get<std::string>().find("is asked which line comes next") != std::string::npos);
    CHECK(bench.ask("GET", "/api/status")["state"] == "idle");
    CHECK(bench.status(bench.request("POST", "/api/prints/none/resume", "{}")) == 404);
    CHECK(bench.ask("POST", "/api/prints/resume", json{{"name", name}, {"sure", true}}.dump())["id"] == id);
    bench.await_job(id, "done");
    await([&] { return past_prints(bench)[0]["ended"] == "completed"; }, bench.daemon());
    const json print = past_prints(bench)[0];
    CHECK(past_prints(bench).size() == 1);
    CHECK(print["seconds"] > failed["seconds"]);
    CHECK(bench.status(bench.request("POST", address, "{}")) == 409);  // it was completed
    bench.transcript();
    check_steps(bench, print);
  }
}

TEST_CASE("a daemon's queue is put into another order, which a killed daemon keeps, and jobs are copied") {
  DaemonBench bench;
  bench.serve();
  for (int i = 0; i < 3; ++i) queue_job(bench);
  CHECK(bench.ask("PUT", "/api/jobs/order", R"({"ids": [3, 1]})")["ids"] == json({3, 1, 2}));
  CHECK(bench.status(bench.request("PUT", "/api/jobs/order", R"({"ids": [3, 9]})")) == 409);
  CHECK(bench.status(bench.request("PUT", "/api/jobs/order", R"({"ids": [3, 3]})")) == 409);
  CHECK(bench.status(bench.request("PUT", "/api/jobs/order", R"({"ids": 3})")) == 400);
  CHECK(order_of(bench) == std::vector<int>{3, 1, 2});
  CHECK(bench.ask("POST", "/api/jobs/1/copy", "{}")["id"] == 4);
  CHECK(bench.status(bench.request("POST", "/api/jobs/9/copy", "{}")) == 404);
  CHECK(bench.ask("GET", "/api/jobs/4")["layers"] == json({0, 0}));
  kill(bench.daemon().id(), SIGKILL);
  bench.daemon().wait();
  bench.serve();
  CHECK(order_of(bench) == std::vector<int>{3, 1, 2, 4});
}

TEST_CASE("a waiting job gets a picture and an estimate, which the next daemon still has") {
  DaemonBench bench;
  bench.serve();
  queue_job(bench, "[0, 4]");
  const auto job = [&] { return bench.ask("GET", "/api/jobs/1"); };
  await([&] { return job().contains("grams"); }, bench.daemon());
  const json estimated = job();
  INFO(estimated.dump());
  CHECK(estimated["layer_count"] == 5);
  // 20 mm x 16 mm x 1 mm at 3 mm³/s, of which the right 8 mm are half sun and half sky.
  CHECK(estimated["seconds"].get<double>() == Approx(320 / 3.0).epsilon(0.02));
  REQUIRE(estimated["grams"].size() == 3);
  CHECK(estimated["grams"][1]["grams"].get<double>() == Approx(128 * 0.5 * 1.24 / 1000).epsilon(0.02));
  const std::string picture = bench.send(bench.request("GET", "/api/jobs/1/picture"));
  const std::size_t png = picture.find("\r\n\r\n\x89PNG");
  REQUIRE(png != std::string::npos);
  const auto width_at = png + 4 + 16;  // big-endian (PNG, 11.2.2 IHDR)
  const int width = static_cast<unsigned char>(picture[width_at + 2]) * 256 +
                    static_cast<unsigned char>(picture[width_at + 3]);
  CHECK(width > 300);
  CHECK(width <= 512);
  CHECK(bench.status(bench.request("GET", "/api/jobs/9/picture")) == 404);
  kill(bench.daemon().id(), SIGKILL);
  bench.daemon().wait();
  bench.serve();
  CHECK(job()["grams"] == estimated["grams"]);
  CHECK(bench.status(bench.request("GET", "/api/jobs/1/picture")) == 200);
}
