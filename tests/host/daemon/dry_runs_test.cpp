// Dry runs that clients ask the daemon for: real child processes.
#include <catch2/catch.hpp>

#include "host/files/web_files.hpp"
#include "tests/host/support/daemon_process.hpp"
#include "tests/host/support/websocket_client.hpp"

using namespace unicursal;
using nlohmann::json;
using test::DaemonBench;

namespace {

json runs(const DaemonBench& bench) {
  return bench.ask("GET", "/api/dry-runs")["dry_runs"];
}

json run_of(const DaemonBench& bench, int id) {
  return bench.ask("GET", "/api/dry-runs/" + std::to_string(id));
}

int begin(const DaemonBench& bench, const std::string& layers = "[0, 0]") {
  const json answer =
      bench.ask("POST", "/api/dry-runs", "{\"job\": \"plate.toml\", \"layers\": " + layers + "}");
  INFO(answer.dump());
  REQUIRE(answer.contains("id"));
  return answer["id"];
}

void await_end(DaemonBench& bench, int id) {
  await([&] { return run_of(bench, id).value("state", "") != "running"; }, bench.daemon());
}

}  // namespace

TEST_CASE("A client tries a job, sees its figures, pictures and page, and removes it") {
  DaemonBench bench;
  bench.serve();
  test::WebSocketClient events(bench.port(), "/api/events",
                               "Authorization: Bearer " + bench.token() + "\r\n");
  CHECK(runs(bench).empty());
  const int id = begin(bench);
  await_end(bench, id);
  const json run = run_of(bench, id);
  INFO(run.dump());
  CHECK(run["state"] == "done");
  CHECK(run["percent"] == 100);
  CHECK(run["layers"] == json({0, 0}));
  CHECK(run["seconds"].get<double>() > 10);
  CHECK(run["gaps_percent"].get<double>() < 5);
  CHECK(run["filaments"].size() == 3);
  CHECK(run["grades"]["time"] == "good");
  const std::string files = "/api/dry-runs/" + std::to_string(id) + "/";
  CHECK(bench.ask("GET", files + "report.json")["ended"] == "completed");
  const std::string picture = bench.send(bench.request("GET", files + "deposit-0000.png"));
  CHECK(picture.find("Content-Type: image/png\r\n") != std::string::npos);
  CHECK(picture.find("\r\n\r\n\x89PNG") != std::string::npos);
  if (!host::web_files().empty()) {
    const std::string page = bench.send(bench.request("GET", files + "index.html"));
    CHECK(page.find("Content-Type: text/html") != std::string::npos);
    CHECK(page.find("Content-Security-Policy: default-src 'none'; script-src 'self'") != std::string::npos);
    CHECK(bench.status(bench.request("GET", files + "viewer.js")) == 200);
  }
  std::string states;
  while (states.find("done") == std::string::npos) {
    const auto event = events.next();
    REQUIRE(event);
    if ((*event)["event"] == "task") states += (*event)["dry_run"]["state"].get<std::string>() + " ";
  }
  CHECK(states.starts_with("running "));
  CHECK(bench.status(bench.request("DELETE", "/api/dry-runs/" + std::to_string(id))) == 200);
  CHECK(bench.status(bench.request("GET", files + "report.json")) == 404);
  CHECK(bench.status(bench.request("DELETE", "/api/dry-runs/" + std::to_string(id))) == 404);
  CHECK(begin(bench) == id + 1);
}

TEST_CASE("Only the files of a dry run are shown, and only a job that a client may name is tried") {
  DaemonBench bench;
  bench.serve();
  const int id = begin(bench);
  await_end(bench, id);
  const std::string folder = bench.path("state/dry-runs/" + std::to_string(id));
  std::filesystem::create_symlink(bench.path("state/token"), folder + "/token.json");
  std::filesystem::create_directory(folder + "/folder.png");
  for (const char* name : {"run.json", "token.json", "folder.png", "nothing.png", "..", "../next", ".png",
                           "a/b.png", "report.json/", "%2e%2e/next", "-x.png", "report"}) {
    INFO(name);
    const int status = bench.status(bench.request("GET", "/api/dry-runs/" + std::to_string(id) + "/" + name));
    CHECK((status == 400 || status == 404));
  }
  for (const char* number : {"0", "99", "1e0", "-1", "18446744073709551617"}) {
    INFO(number);
    CHECK(bench.status(bench.request("GET", std::string("/api/dry-runs/") + number + "/report.json")) == 404);
  }
  CHECK(bench.status(bench.request("POST", "/api/dry-runs", "{\"job\": \"../secret.toml\"}")) != 201);
  CHECK(bench.status(bench.request("POST", "/api/dry-runs", "{\"job\": \"none.toml\"}")) == 404);
  CHECK(bench.status(bench.request("POST", "/api/dry-runs", "{\"layers\": [0, 1]}")) == 400);
  CHECK(bench.status(
            bench.request("POST", "/api/dry-runs", "{\"job\": \"plate.toml\", \"layers\": [3, 1]}")) == 422);
}

TEST_CASE("One dry run at a time, and a running one is ended with its removal and with the daemon") {
  DaemonBench bench;
  bench.serve();
  const int id = begin(bench, "[0, 1999]");
  CHECK(bench.status(bench.request("POST", "/api/dry-runs", "{\"job\": \"plate.toml\"}")) == 409);
  CHECK(bench.status(bench.request("DELETE", "/api/dry-runs/" + std::to_string(id))) == 200);
  const int second = begin(bench, "[0, 1999]");
  kill(bench.daemon().id(), SIGKILL);
  bench.daemon().wait();
  bench.serve();
  const json found = run_of(bench, second);
  CHECK(found["state"] == "failed");
  CHECK(found["reason"].get<std::string>().find("begin it again") != std::string::npos);
  const int third = begin(bench, "[2000, 2000]");  // the plate has two thousand layers
  await_end(bench, third);
  CHECK(run_of(bench, third)["state"] == "failed");
  CHECK(run_of(bench, third)["reason"].get<std::string>().size() > 20);
}

TEST_CASE("The newest ten dry runs are kept") {
  DaemonBench bench;
  for (int old = 1; old <= 10; ++old) {
    std::filesystem::create_directories(bench.path("state/dry-runs/" + std::to_string(old)));
    bench.folder().write("state/dry-runs/" + std::to_string(old) + "/run.json",
                         "{\"job\": \"plate.toml\", \"state\": \"done\"}");
  }
  std::filesystem::create_directories(bench.path("state/dry-runs/notes"));
  bench.folder().write("state/dry-runs/7/run.json", "{\"job\": [], \"state\": 5}");  // damaged
  std::filesystem::permissions(bench.path("state"), std::filesystem::perms::owner_all);
  bench.serve();
  CHECK(runs(bench).size() == 9);
  begin(bench);
  CHECK(runs(bench).size() == 10);
  await_end(bench, 11);
  CHECK(begin(bench) == 12);
  CHECK(runs(bench).size() == 10);
  CHECK(run_of(bench, 1).contains("error"));
  CHECK_FALSE(std::filesystem::exists(bench.path("state/dry-runs/1")));
}
