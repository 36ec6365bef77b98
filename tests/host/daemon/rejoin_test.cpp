// Prints of a daemon that are interrupted: its cable is pulled, or it dies. The simulated printer lives on.
#include <catch2/catch.hpp>

#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using nlohmann::json;
using test::DaemonBench;
using test::Outcome;

namespace {

int add(const DaemonBench& bench, const std::string& layers) {
  const Outcome added = bench.command({"queue", "--add", "plate.toml", "--layers", layers});
  INFO(added.err);
  REQUIRE(added.code == 0);
  return std::stoi(added.out);
}

json job(const DaemonBench& bench, int id) {
  return bench.ask("GET", "/api/jobs/" + std::to_string(id));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A daemon that was killed while its printer was laying plastic, and another in its place.
struct Killed {
  explicit Killed(const std::string& layers) {
    bench.start_printer("100");
    bench.serve();
    id = add(bench, layers);
    REQUIRE(bench.command({"start"}).code == 0);
    // So many lines that some of them have certainly been run.
    test::await([&] { return count(test::read_text(bench.path("lines.txt")), "\nG1 ") > 100; },
                bench.daemon());
    kill(bench.daemon().id(), SIGKILL);
    bench.daemon().wait();
  }
  DaemonBench bench;
  int id = 0;
};

}  // namespace

TEST_CASE("a print of the daemon goes on by itself after its cable was pulled") {
  DaemonBench bench;
  bench.start_printer("100", {"--fault", "disconnect:100@line=400"});
  bench.serve();
  const int id = add(bench, "0:4");
  REQUIRE(bench.command({"start"}).code == 0);
  test::await([&] { return bench.ask("GET", "/api/status")["state"] == "reconnecting"; }, bench.daemon());
  CHECK(bench.status(bench.request("POST", "/api/print/pause")) == 409);
  CHECK(bench.ask("GET", "/api/status")["print"].contains("layer"));
  bench.await_job(id, "done");
  CHECK(says(bench.daemon().err(), "the printer is back"));
  const std::string lines = bench.transcript();
  CHECK(count(lines, "G28") == 1);  // it had not lost its place
  CHECK(count(lines, "M109") == 1);
  CHECK(lines.rfind("M104 S0") > lines.rfind("G1 "));
}

TEST_CASE("a cancelled print of the daemon whose cable is pulled is cooled when it is back") {
  DaemonBench bench;
  bench.folder().write("jobs/bench.toml.profile", test::tall_profile() + "[gcode]\nend = \"M400\"\n");
  bench.start_printer("100", {"--fault", "disconnect:100@command=M400"});  // while it parks
  bench.serve();
  const int id = add(bench, "0:1999");
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_print("printing");
  REQUIRE(bench.command({"cancel"}).code == 0);
  bench.await_job(id, "failed");
  const auto cooled = [&] {
    const std::string lines = test::read_text(bench.path("lines.txt"));
    const std::size_t back = lines.find("M115", lines.find("M400"));
    return back != std::string::npos && lines.find("M104 S0", back) != std::string::npos &&
           lines.find("M140 S0", back) != std::string::npos;
  };
  test::await(cooled, bench.daemon());
}

TEST_CASE("a print whose printer does not come back can be cancelled, and is offered") {
  DaemonBench bench;
  bench.start_printer("100", {"--fault", "disconnect:100000@line=400"});
  bench.serve();
  const int id = add(bench, "0:4");
  REQUIRE(bench.command({"start"}).code == 0);
  test::await([&] { return bench.ask("GET", "/api/status")["state"] == "reconnecting"; }, bench.daemon());
  REQUIRE(bench.command({"cancel"}).code == 0);
  bench.await_job(id, "failed");
  CHECK(says(job(bench, id)["reason"], "cable"));
  CHECK(bench.ask("GET", "/api/status")["interrupted"]["id"] == id);
  kill(bench.daemon().id(), SIGTERM);
  CHECK(bench.daemon().wait().code == 0);
}

TEST_CASE("a daemon that was killed offers its print, and goes on with the next line") {
  Killed killed("0:4");
  DaemonBench& bench = killed.bench;
  bench.serve();
  const json status = bench.ask("GET", "/api/status");
  CHECK(status["state"] == "idle");
  CHECK(status["interrupted"]["id"] == killed.id);
  CHECK(status["interrupted"]["job"] == "plate.toml");
  CHECK(says(bench.command({"status"}).out, "was interrupted: continue it with `unicursal resume`"));
  const int next = add(bench, "0:0");
  CHECK(bench.status(bench.request("POST", "/api/print/start")) == 409);  // it would print into the part
  CHECK(says(bench.command({"start"}).err, "--bed-clear"));
  CHECK(job(bench, next)["state"] == "queued");
  const Outcome resumed = bench.command({"resume"});
  INFO(resumed.out << resumed.err);
  REQUIRE(resumed.code == 0);
  bench.await_job(killed.id, "done");
  CHECK_FALSE(bench.ask("GET", "/api/status").contains("interrupted"));
  CHECK_FALSE(std::filesystem::exists(bench.path("state/printing")));
  const std::string lines = bench.transcript();
  CHECK(count(lines, "G28") == 1);
  CHECK(lines.rfind("M104 S0") > lines.rfind("G1 "));
}

TEST_CASE("a daemon asks before it continues a print whose printer has lost its place") {
  Killed killed("0:4");
  DaemonBench& bench = killed.bench;
  bench.transcript();  // switches the printer off
  bench.start_printer("100");
  bench.serve();
  CHECK(bench.status(bench.request("POST", "/api/print/resume", "{\"sure\": true}")) == 409);  // of what?
  const Outcome asked = bench.command({"resume"});
  INFO(asked.out << asked.err);
  CHECK(asked.code == 2);
  CHECK(says(asked.out, "homes x and y"));
  CHECK(says(asked.err, "--yes"));
  CHECK(job(bench, killed.id)["state"] == "interrupted");
  CHECK(says(bench.ask("GET", "/api/status")["interrupted"]["question"], "homes x and y"));
  CHECK(bench.status(bench.request("POST", "/api/print/start")) == 409);
  const Outcome confirmed = bench.command({"resume", "--yes"});
  INFO(confirmed.out << confirmed.err);
  REQUIRE(confirmed.code == 0);
  bench.await_job(killed.id, "done");
  const std::string lines = bench.transcript();
  CHECK(count(lines, "G28 X Y") == 1);
  CHECK(count(lines, "G28") == 1);  // z is not homed onto the part
}

TEST_CASE("a job is started over an interrupted print once the bed is said to be clear") {
  Killed killed("0:4");
  DaemonBench& bench = killed.bench;
  bench.serve();
  const int next = add(bench, "0:0");
  CHECK(bench.status(bench.request("POST", "/api/print/start", "{\"bed_clear\": 1}")) == 400);
  REQUIRE(bench.command({"start", "--bed-clear"}).code == 0);
  bench.await_job(next, "done");
  CHECK_FALSE(bench.ask("GET", "/api/status").contains("interrupted"));
  CHECK(bench.command({"resume"}).code == 2);
}
