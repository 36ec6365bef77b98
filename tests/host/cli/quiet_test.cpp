// --quiet: only warnings, errors and the end.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/host/support/print_bench.hpp"
#include "tests/host/support/terminal.hpp"

using namespace unicursal;
using Catch::Matchers::Contains;
using test::Outcome;
using test::PrintBench;
using test::run;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("a quiet print says when it was done, and nothing else") {
  PrintBench bench(0);
  const Outcome outcome = run(bench.print({"--quiet"}));
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  REQUIRE(lines_of(outcome.out).size() == 1);
  CHECK_THAT(outcome.out, Contains("done at "));
}

TEST_CASE("a quiet plan names its file, and a quiet dry run its time") {
  const PrintBench bench(0);
  const Outcome plan = run({"plan", bench.path("job.toml"), "-q", "-o", bench.path("a.gcode")});
  CHECK(plan.code == 0);
  CHECK(plan.err.empty());
  CHECK(plan.out == "written:   " + bench.path("a.gcode") + "\n");
  const Outcome dry = run({"dry-run", bench.path("job.toml"), "-q"});
  CHECK(dry.code == 0);
  CHECK(dry.err.empty());
  REQUIRE(lines_of(dry.out).size() == 1);
  CHECK_THAT(dry.out, Contains("done:      the print takes "));
}

TEST_CASE("a quiet command still warns, and says why it fails") {
  PrintBench bench(0, {"--fault", "unguarded@t=0"},
                   test::sample_profile + std::string("\n[gcode]\nstart = \"M9999\"\n"));
  const Outcome outcome = run(bench.print({"--quiet"}));
  CHECK(outcome.code == 0);
  CHECK_THAT(outcome.err, Contains("Warning: the printer does not know one of the lines that prepare it"));
  CHECK(outcome.err.find("layer") == std::string::npos);
  CHECK_THAT(run({"plan", bench.path("none.toml"), "-q", "-o", bench.path("a")}).err,
             Contains("does not exist"));
}

TEST_CASE("a quiet print shows nothing in a terminal until it ends, and what is typed is answered") {
  const int width = GENERATE(60, 80, 120);
  PrintBench bench(100, {}, test::tall_profile());
  bench.folder().write("job.toml", test::tall_job());
  test::Terminal terminal(bench.print({"-q"}), "/nonexistent", {static_cast<unsigned short>(width)});
  PrintBench::wait_for([&] { return test::read_text(bench.path("t.txt")).find("G1 ") != std::string::npos; },
                       bench.printer());
  terminal.type("speed 120\n");
  terminal.await("speed is 120 % now");
  terminal.type("pause\n");
  terminal.await("paused: ");
  terminal.type("\x03");
  CHECK(terminal.wait() == 3);
  for (const std::string& row : terminal.screen().rows()) CHECK(row.find("layer") == std::string::npos);
}

TEST_CASE("events are the same with --quiet") {
  PrintBench bench(0);
  const auto kinds = [&](const std::vector<std::string>& more) {
    const Outcome outcome = run(bench.print(more));
    CHECK(outcome.code == 0);
    std::vector<std::string> states;
    for (const std::string& line : lines_of(outcome.out)) {
      const auto event = nlohmann::json::parse(line);
      if (event.value("event", "") == "state") states.push_back(event["status"]["state"]);
      if (event.value("event", "") == "end") states.push_back("end");
    }
    return states;
  };
  const auto loud = kinds({"--json"});
  CHECK(loud.back() == "end");
  CHECK(kinds({"--json", "--quiet"}) == loud);
}

TEST_CASE("a quiet resume shows the end only") {
  PrintBench bench(100);
  {
    test::Child host(bench.print());
    PrintBench::wait_for(
        [&] { return test::read_text(bench.path("t.txt")).find("G1 X") != std::string::npos; }, host);
    kill(host.id(), SIGKILL);
    host.wait();
  }
  auto words = bench.resume();
  words.insert(words.end(), {"--yes", "--quiet"});
  const Outcome outcome = run(words);
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.err.find("layer") == std::string::npos);
  CHECK_THAT(lines_of(outcome.out).back(), Contains("done at "));
}
