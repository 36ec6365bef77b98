// Dry runs in virtual time, as real processes: host and simulator in lockstep.
#include <fmt/format.h>
#include <poll.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using nlohmann::json;
using test::Outcome;

constexpr const char* barely_warm = R"(
[temperature]
nozzle = 175
bed = 0
)";

/// Dry runs of the sample job, each with its report.
class Runs {
 public:
  Runs() {
    folder_.write("bench.toml", test::sample_profile);
    folder_.write("plate.svg", test::sample_drawing);
    folder_.write("job.toml", test::sample_job);
  }

  Outcome run(const std::vector<std::string>& more) {
    std::vector<std::string> all{"dry-run", (folder_ / "job.toml").string(), "--report", report().string()};
    all.insert(all.end(), more.begin(), more.end());
    return test::run(all);
  }
  /// Planning time of this computer for the whole job; builds differ by factors of ten.
  double planning_seconds() const {
    const Outcome plan = test::run({"plan", (folder_ / "job.toml").string(), "-o",
                                    (folder_ / "job.gcode").string(), "--report", report().string()});
    REQUIRE(plan.code == 0);
    return seen()["planning"]["cpu_seconds"];
  }
  void write_profile(const std::string& text) { folder_.write("bench.toml", text); }
  std::string text() const { return test::read_text(report()); }
  json seen() const { return json::parse(text()); }
  const std::filesystem::path& folder() const { return folder_.path(); }
  std::filesystem::path report() const { return folder_ / "report.json"; }

 private:
  test::TempFolder folder_;
};

}  // namespace

TEST_CASE("The same dry run twice gives the same report, byte for byte") {
  Runs runs;
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{},
        {"--fault", "bitflip:2e-4", "--fault", "noise:0.01", "--fault", "lostok:0.002", "--usb", "ftdi"}}) {
    REQUIRE(runs.run(more).code == 0);
    const std::string first = runs.text();
    REQUIRE(runs.run(more).code == 0);
    CHECK(runs.text() == first);
  }
}

TEST_CASE("Another seed gives other faults, and every line is still executed once, in order") {
  Runs runs;
  std::vector<json> faults;
  for (const char* seed : {"1", "2"}) {
    REQUIRE(runs.run({"--fault", "bitflip:3e-4", "--seed", seed}).code == 0);
    const json seen = runs.seen()["simulator"];
    CHECK(seen["executed_lines_in_order"] == true);
    CHECK(seen["faults"]["bitflip"] > 0);
    CHECK(seen["lines"]["unseen_damage"] == 0);
    faults.push_back(seen["lines"]);
  }
  CHECK(faults[0] != faults[1]);
}

TEST_CASE("Charged planning makes the print wait in printer time") {
  Runs runs;
  runs.write_profile(std::string(test::sample_profile) +
                     barely_warm);  // or planning would be done while the printer heats
  REQUIRE(runs.run({}).code == 0);
  const json free = runs.seen();
  REQUIRE(runs.run({"--charge-planning", fmt::format("{}", 600 / runs.planning_seconds())}).code == 0);
  const json charged = runs.seen();
  CHECK(free["planning"]["waited_seconds"] == 0);
  const double waited = charged["planning"]["waited_seconds"];
  CHECK(waited > 1);
  const double longer = charged["simulator"]["printer_seconds"].get<double>() -
                        free["simulator"]["printer_seconds"].get<double>();
  CHECK(longer > 0);
  CHECK(longer < waited + 5);
}

TEST_CASE("A silent printer is given up after the timeout of a real print, in printer time") {
  Runs runs;
  const Outcome outcome = runs.run({"--fault", "silence@line=200"});
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("fallen silent") != std::string::npos);
  const json report = runs.seen();
  CHECK(report["ended"] == "failed");
  CHECK(report["simulator"]["faults"]["silence"] == 1);
}

TEST_CASE(
    "A cable that is pulled, a board that resets and a thermistor that falls out end a print with a reason") {
  Runs runs;
  const auto [fault, reason] = GENERATE(table<std::string, std::string>({
      {"disconnect@line=300", "connection to the printer was lost"},
      {"reset@line=300", "has reset itself"},
      {"thermistor@line=300", "MINTEMP triggered"},
      {"fatal:Something broke@line=300", "Something broke"},
  }));
  const Outcome outcome = runs.run({"--fault", fault});
  INFO(outcome.err);
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find(reason) != std::string::npos);
  CHECK(runs.seen()["simulator"]["faults"].size() == 1);
}

TEST_CASE("A simulator that fails at its very end leaves a report that says so") {
  Runs runs;
  const std::filesystem::path pictures = runs.folder() / "pictures";
  // A folder takes the place of its last picture; repeated in case the picture was there first.
  for (bool blocked = false; !blocked;) {
    std::filesystem::remove_all(pictures);
    test::Child child({"dry-run", (runs.folder() / "job.toml").string(), "--report", runs.report().string(),
                       "--picture", pictures.string()});
    while (child.running() && !std::filesystem::exists(pictures / "curve-0000.png")) poll(nullptr, 0, 1);
    std::error_code taken;
    blocked = std::filesystem::create_directory(pictures / "motion.png", taken);
    const Outcome outcome = child.wait();
    if (!blocked) continue;
    INFO(outcome.err);
    CHECK(outcome.code == 1);
    const json report = runs.seen();
    CHECK(report["ended"] == "failed");
    CHECK(report["reason"].get<std::string>().find("simulator ended with exit code") != std::string::npos);
    CHECK(report["layer_count"] == 2);
    CHECK(report["laid"]["layers"].size() == 2);
  }
}

TEST_CASE("Every personality that the host supports prints a whole job") {
  Runs runs;
  const std::string who = GENERATE("marlin", "marlin-8bit", "marlin-advanced-ok");
  const Outcome outcome = runs.run({"--personality", who});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(runs.seen()["simulator"]["personality"] == who);
  CHECK(runs.seen()["simulator"]["lines"]["bytes_while_booting"] == 0);
}

TEST_CASE("Unknown faults, personalities and chips are refused with a list of the known ones") {
  Runs runs;
  const auto [option, value, answer] = GENERATE(table<std::string, std::string, std::string>({
      {"--fault", "gremlin:0.1", "bitflip"},
      {"--fault", "bitflip:2", "from 0 to 1"},
      {"--fault", "reset", "needs a moment"},
      {"--personality", "klipper", "repetier"},
      {"--usb", "rs232", "ftdi"},
      {"--faults", "/nowhere/faults", "/nowhere/faults"},
  }));
  const Outcome outcome = runs.run({option, value});
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find(answer) != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(runs.report()));
}

}  // namespace unicursal
