// Whole dry runs on printers with two to eight feeders.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "firmware_gcode/print/per_feeder.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "tests/paths.hpp"

namespace unicursal {
namespace {

using nlohmann::json;
using test::replaced;

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// "[0.7, 0.3, 0, 0]": the first two feeders, and zeros for the others.
std::string shares(double first, double second, std::size_t feeders) {
  std::string text = fmt::format("[{}, {}", first, second);
  for (std::size_t f = 2; f < feeders; ++f) text += ", 0";
  return text + "]";
}

std::string job_for(std::size_t feeders) {
  std::string job = replaced(test::sample_job, "[0.6, 0.0, 0.2]", shares(0.7, 0.3, feeders));
  return replaced(job, "[0.0, 1.0, 1.0]", shares(0, 1, feeders));
}

/// No share is raised and no inlet purged, so that only the first two feeders turn whatever the number.
std::string profile_for(const std::string& firmware, std::size_t feeders) {
  std::string profile = replaced(test::sample_profile, "\"marlin\"", "\"" + firmware + "\"");
  return replaced(profile, "feeders = 3",
                  fmt::format("feeders = {}\nfloor_share = 0\npurge_inlets = false", feeders));
}

test::Outcome dry_run(const test::TempFolder& folder, const std::string& firmware, std::size_t feeders) {
  folder.write("bench.toml", profile_for(firmware, feeders));
  folder.write("plate.svg", test::sample_drawing);
  return test::run({"dry-run", folder.write("job.toml", job_for(feeders)).string(), "--report",
                    (folder / "report.json").string()});
}

json report_of(const std::string& firmware, std::size_t feeders) {
  const test::TempFolder folder;
  const test::Outcome outcome = dry_run(folder, firmware, feeders);
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  return json::parse(test::read_text(folder / "report.json"));
}

}  // namespace

TEST_CASE("Two to eight feeders leave the same deposit, up to the shares' rounding", "[optimised]") {
  struct Case {
    const char* firmware;
    std::size_t feeders;
    double rounding;  ///< of a share
  };
  const json three = report_of("marlin", 3);
  for (const auto& [firmware, feeders, rounding] :
       {Case{"marlin", 2, 1e-4}, Case{"marlin", 4, 1e-4}, Case{"marlin", 8, 1e-4}, Case{"repetier", 2, 0.01},
        Case{"repetier", 4, 0.01}, Case{"reprapfirmware", 8, 1e-4}}) {
    const json other = report_of(firmware, feeders);
    INFO(firmware << " with " << feeders);
    CHECK(other["simulator"]["feeders"].size() == feeders);
    for (const char* key : {"area_mm2", "gap_mm2", "overfill_mm2", "spilled_mm2"}) {
      INFO(key);
      CHECK(other["laid"]["total"][key].get<double>() ==
            Approx(three["laid"]["total"][key].get<double>()).epsilon(1e-3).margin(0.05));
    }
    const double all = other["extruded_mm3"];
    CHECK(all == Approx(three["extruded_mm3"].get<double>()).epsilon(1e-6));
    REQUIRE(other["feeder_volumes_mm3"].size() == feeders);
    for (std::size_t f = 0; f < feeders; ++f) {
      const double expected = f < 2 ? three["feeder_volumes_mm3"][f].get<double>() : 0;
      CHECK(std::abs(other["feeder_volumes_mm3"][f].get<double>() - expected) / all <= rounding);
    }
    CHECK(other["comparison"]["worst_relative_error"].get<double>() < 0.01);
    CHECK(other["comparison"]["lines_lost"] == 0);
    CHECK(other["simulator"]["warnings"].empty());
  }
}

TEST_CASE("A job whose mixtures have other feeders than its profile is refused") {
  const test::TempFolder folder;
  folder.write("bench.toml", profile_for("marlin", 4));
  folder.write("plate.svg", test::sample_drawing);
  const test::Outcome outcome =
      test::run({"plan", folder.write("job.toml", job_for(3)).string(), "-o", (folder / "a.gcode").string()});
  CHECK(outcome.code == 2);
  CHECK(says(outcome.err, "has 3 shares, but the printer has 4 feeders"));
}

TEST_CASE("More feeders than a firmware drives are refused") {
  const test::TempFolder folder;
  CHECK(says(dry_run(folder, "repetier", 7).err, "2 to 6 with repetier"));
  const test::Outcome simulated = test::run({"simulate", "--personality", "repetier", "--feeders", "7"});
  CHECK(simulated.code == 2);
  CHECK(says(simulated.err, "repetier has 1 to 6 feeders"));
}

}  // namespace unicursal
