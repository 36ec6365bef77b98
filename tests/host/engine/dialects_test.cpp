// Whole dry runs: the same job in every dialect, and the estimates of the program compared with what the
// simulated printer does.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/host/support/child_process.hpp"
#include "tests/host/support/json_events.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "tests/paths.hpp"

namespace unicursal {
namespace {

using nlohmann::json;
using test::replaced;

/// The report of a dry run of a job on a profile.
json dry_run(const std::string& job, const std::string& profile) {
  const test::TempFolder folder;
  folder.write("bench.toml", profile);
  folder.write("plate.svg", test::sample_drawing);
  const auto file = folder.write("job.toml", job);
  const test::Outcome outcome =
      test::run({"dry-run", file.string(), "--report", (folder / "report.json").string()});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  return json::parse(test::read_text(folder / "report.json"));
}

const std::string marlin = test::sample_profile;
const std::string repetier = replaced(marlin, "firmware = \"marlin\"", "firmware = \"repetier\"");
const std::string reprapfirmware = replaced(marlin, "firmware = \"marlin\"", "firmware = \"reprapfirmware\"");

const std::string& profile_for(const std::string& firmware) {
  if (firmware == "repetier") return repetier;
  return firmware == "reprapfirmware" ? reprapfirmware : marlin;
}

}  // namespace

TEST_CASE("The same job in every dialect leaves the same deposit, up to the shares' rounding") {
  const auto [second, rounding] =
      GENERATE(table<std::string, double>({{"repetier", 0.01}, {"reprapfirmware", 0.0003}}));
  const json a = dry_run(test::sample_job, marlin), b = dry_run(test::sample_job, profile_for(second));
  CHECK(a["simulator"]["personality"] == "marlin");
  CHECK(b["simulator"]["personality"] == second);
  for (const char* key : {"area_mm2", "gap_mm2", "overfill_mm2", "spilled_mm2"}) {
    INFO(key);
    CHECK(b["laid"]["total"][key].get<double>() ==
          Approx(a["laid"]["total"][key].get<double>()).epsilon(1e-3).margin(0.05));
  }
  CHECK(a["extruded_mm3"] == b["extruded_mm3"]);
  double all = 0, difference = 0;
  for (std::size_t feeder = 0; feeder < 3; ++feeder) {
    const double one = a["feeder_volumes_mm3"][feeder], other = b["feeder_volumes_mm3"][feeder];
    all += one;
    difference = std::max(difference, std::abs(one - other));
  }
  CHECK(difference / all < rounding);  // parts of a hundred, or of ten thousand
  for (const json& report : {a, b}) {
    CHECK(report["comparison"]["worst_relative_error"].get<double>() < 0.01);
    CHECK(report["simulator"]["warnings"].empty());
  }
}

TEST_CASE("Each feeder has moved before the part begins, in every dialect") {
  const std::string firmware = GENERATE("marlin", "repetier", "reprapfirmware");
  CAPTURE(firmware);
  const json report = dry_run(test::sample_job, profile_for(firmware));
  const json& mixtures = report["simulator"]["mixtures"];  // in the order of their first use
  REQUIRE(mixtures.size() >= 5);
  const double least = 4 / (std::numbers::pi / 4 * 1.75 * 1.75);  // mm of filament
  for (std::size_t feeder = 0; feeder < 3; ++feeder) {
    CHECK(mixtures[feeder]["shares"][feeder].get<double>() == Approx(0.8).epsilon(0.01));
    CHECK(mixtures[feeder]["extruded_mm"].get<double>() == Approx(least).epsilon(0.01));
  }
  CHECK(report["comparison"]["worst_relative_error"].get<double>() < 0.01);
  double prime = 0;
  for (const json& mixture : report["mixtures"]) prime += mixture["prime_mm3"].get<double>();
  CHECK(prime == Approx(2 * 6.1 + 3 * 4).epsilon(0.01));
  CHECK(report["simulator"]["warnings"].empty());
}

TEST_CASE("The printing time is estimated within 2 % for every kind of job", "[optimised]") {
  const auto [job, profile] = GENERATE(table<std::string, std::string>({
      {test::sample_job, marlin},
      {test::sample_job, repetier},
      {test::sample_job, reprapfirmware},
      {replaced(test::sample_job, "flow = 3.0", "flow = 5.0"), marlin},
      {replaced(test::sample_job, "flow = 3.0", "speed = 60"), marlin},
      {replaced(test::sample_job, "flow = 3.0", "flow = \"auto\"\nskirt = 2\nfirst_layer_speed = 0.5"),
       marlin},
      {replaced(test::sample_job, "flow = 3.0", "first_layer_height = 0.3\nfan = 50"),
       replaced(marlin, "max_flow = 5.0", "max_flow = 5.0\nz_hop = 0.4")},
      {replaced(test::sample_job, "flow = 3.0", "flow = 5.0"),
       replaced(marlin, "nozzle = 0.6", "nozzle = 0.6\njunction_deviation = 0.02\nacceleration = 800")},
  }));
  const json report = dry_run(job, profile);
  const double told = report["estimated_laying_seconds"];
  const double taken = report["simulator"]["printing_seconds"];
  INFO(job);
  CHECK(told == Approx(taken).epsilon(0.02));
  CHECK(report["estimated_print_seconds"].get<double>() > told);
}

TEST_CASE("Events name the job's mixtures, in every dialect and with feeders that slip") {
  const std::string firmware = GENERATE("marlin", "repetier");
  const std::string factors = GENERATE("", "flow_factors = [1, 1.05, 1]\n");
  CAPTURE(firmware, factors);
  const test::TempFolder folder;
  folder.write("bench.toml", profile_for(firmware) + factors);
  folder.write("plate.svg", test::sample_drawing);
  const auto file = folder.write("job.toml", test::sample_job);
  const test::Outcome outcome = test::run({"dry-run", file.string(), "--json"});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(test::mixtures_named(outcome.out) == std::set<std::string>{"sea", "sun"});
}

TEST_CASE("The example with feeders that slip names its mixtures", "[optimised]") {
  const std::string firmware = GENERATE("marlin", "repetier");
  const std::filesystem::path examples = test::source_folder() / "host/examples";
  const test::TempFolder folder;
  folder.write("leaf.svg", test::read_text(examples / "leaf.svg"));
  folder.write("diamond.toml",
               test::replaced(test::replaced(test::read_text(examples / "diamond.toml"), "[extruder]",
                                             "[extruder]\nflow_factors = [1, 1.05, 1]"),
                              "\"marlin\"", "\"" + firmware + "\""));
  const auto file = folder.write("leaf.toml", test::read_text(examples / "leaf.toml"));
  const test::Outcome outcome = test::run({"dry-run", file.string(), "--layers", "0:0", "--json"});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const std::set<std::string> named = test::mixtures_named(outcome.out);
  CHECK(named.count("coral") == 1);
  for (const std::string& mixture : named) CHECK((mixture == "coral" || mixture == "sea"));
}

TEST_CASE("Feeders that slip are corrected by their factors, and the report shows what arrives") {
  const json report = dry_run(test::sample_job, replaced(marlin, "max_flow = 5.0",
                                                         "max_flow = 5.0\nflow_factors = [1.1, 1, 0.95]\n"
                                                         "steps_per_mm = 420"));
  CHECK(report["comparison"]["worst_relative_error"].get<double>() < 0.01);
}

TEST_CASE("A layer may be cooler or hotter than the one before, in every dialect, without a pause",
          "[optimised]") {
  for (const char* const firmware : {"marlin", "repetier", "reprapfirmware"}) {
    for (const int nozzle : {190, 205, 225}) {
      const test::TempFolder folder;
      folder.write("bench.toml", profile_for(firmware));
      folder.write("plate.svg", test::sample_drawing);
      const auto job = folder.write(
          "job.toml", replaced(replaced(test::sample_job, "height = 0.4", "height = 1.2"), "flow = 3.0",
                               "flow = 3.0\ntemperatures = [{ layer = 1, nozzle = " + std::to_string(nozzle) +
                                   ", bed = 50 }]"));
      const test::Outcome outcome = test::run({"dry-run", job.string()});
      INFO(firmware << ", " << nozzle << " °C: " << outcome.err);
      CHECK(outcome.code == 0);
      CHECK(outcome.err.find("paus") == std::string::npos);
    }
  }
}

}  // namespace unicursal
