// Commands on a slicer's G-code, run as real processes.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/firmware_gcode/support/sliced_block.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using Catch::Matchers::Contains;
using test::Outcome;
using test::run;
using test::TempFolder;

class Files {
 public:
  explicit Files(const gcode::test::BlockOptions& options,
                 const std::string& profile_text = test::sample_profile) {
    block = gcode::test::sliced_block(options);
    profile = folder.write("bench.toml", profile_text).string();
    file = folder.write("block.gcode", block.text).string();
  }
  Outcome dry_run(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"dry-run", file, "--profile", profile, "--report", folder / "report.json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  nlohmann::json report() const { return nlohmann::json::parse(test::read_text(folder / "report.json")); }

  TempFolder folder;
  gcode::test::Block block;
  std::string profile, file;
};

gcode::test::BlockOptions few_layers() {
  gcode::test::BlockOptions options;
  options.layers = 4;
  return options;
}

double filament_of(const gcode::test::Block& block) {
  double filament = 0;
  for (const gcode::test::BlockBead& bead : block.beads) filament += bead.filament;
  return filament;
}

}  // namespace

TEST_CASE("A dry run of a slicer's G-code reports what was laid, by the file's own beads") {
  const Files files(few_layers());
  const Outcome outcome = files.dry_run({"--picture", files.folder / "pictures"});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK_THAT(outcome.out, Contains("4 layers, sliced by PrusaSlicer 2.7.1"));
  CHECK_THAT(outcome.out, Contains("0 lines lost, 0 run twice, all in order"));
  const nlohmann::json report = files.report();
  CHECK(report["ended"] == "completed");
  CHECK(report["sliced"]["slicer"] == "PrusaSlicer 2.7.1");
  CHECK(report["sliced"]["tools"].size() == 2);
  CHECK(report["layers"].size() == 4);
  CHECK(report["layers"][3]["top_mm"] == Approx(0.8));
  constexpr double filament_area = 2.405;
  CHECK(report["extruded_mm3"].get<double>() ==
        Approx(filament_of(files.block) * filament_area).epsilon(1e-3));
  CHECK(report["comparison"]["worst_relative_error"].get<double>() < 0.01);
  const nlohmann::json& laid = report["laid"]["total"];
  CHECK(laid["area_mm2"].get<double>() > 100);
  CHECK(laid["gap_fraction"].get<double>() < 0.05);  // sparse infill is not a gap
  CHECK(laid["mixture"]["transition_mm2"].get<double>() > 0.2 * laid["area_mm2"].get<double>());
  CHECK(laid["mixture"]["wrong_mm2"].get<double>() < 0.02 * laid["area_mm2"].get<double>());
  CHECK(report["laid"]["layers"].size() == 4);
  CHECK(std::filesystem::exists(files.folder / "pictures/gaps-0003.png"));
  CHECK(std::filesystem::exists(files.folder / "pictures/mixtures-0000.png"));
}

TEST_CASE("Without look-ahead the report of a slicer's G-code shows the wrong plastic") {
  // A large chamber, or the inner walls would take up the whole change.
  const Files files(few_layers(), std::string(test::sample_profile) +
                                      "[transition]\ndead_volume = 10.0\nmixing_volume = 25.0\n");
  REQUIRE(files.dry_run().code == 0);
  const double ahead = files.report()["laid"]["total"]["mixture"]["wrong_mm2"];
  REQUIRE(files.dry_run({"--no-look-ahead"}).code == 0);
  const double late = files.report()["laid"]["total"]["mixture"]["wrong_mm2"];
  CHECK(late > 3 * ahead);
  CHECK(late > 1);
}

TEST_CASE("The wipe tower of a slicer's G-code is left out if the user wants it") {
  gcode::test::BlockOptions options = few_layers();
  options.tower = true;
  const Files files(options, test::replaced(test::sample_profile, "120.0, 100.0", "200.0, 200.0"));
  REQUIRE(files.dry_run().code == 0);
  const nlohmann::json whole = files.report();
  const Outcome outcome = files.dry_run({"--no-tower"});
  REQUIRE(outcome.code == 0);
  CHECK_THAT(outcome.out, Contains("of the wipe tower left out"));
  const nlohmann::json without = files.report();
  const double tower = whole["sliced"]["tower_mm3"];
  CHECK(tower > 1);
  CHECK(without["sliced"]["left_out_mm3"].get<double>() == Approx(tower).epsilon(0.02));
  CHECK(without["extruded_mm3"].get<double>() ==
        Approx(whole["extruded_mm3"].get<double>() - tower).epsilon(0.02));
}

TEST_CASE("Inspect shows a slicer's G-code, and new writes a job for it that prints the same") {
  const Files files(few_layers());
  const Outcome shown = run({"inspect", files.file, "--profile", files.profile});
  INFO(shown.out << shown.err);
  CHECK(shown.code == 0);
  CHECK_THAT(shown.out, Contains("slicer:  PrusaSlicer 2.7.1") && Contains("T1") && Contains("#00ff00"));
  CHECK_THAT(shown.out, Contains("fits:    yes") && Contains("in 4 layers"));
  const std::string job = files.folder / "block.toml";
  const Outcome written = run({"new", files.file, "-o", job, "--profile", files.profile});
  INFO(written.err);
  REQUIRE(written.code == 0);
  CHECK_THAT(written.out, Contains("with 2 zones"));
  const Outcome printed = run({"dry-run", job});
  INFO(printed.err);
  CHECK(printed.code == 0);
  CHECK_THAT(printed.out, Contains("4 layers, sliced by PrusaSlicer"));
}

TEST_CASE("What would break the print is refused before anything heats, with a remedy") {
  const Files files(few_layers());
  const auto refused = [&](const std::string& line) {
    const std::string file =
        files.folder.write("bad.gcode", test::replaced(files.block.text, ";LAYER_CHANGE\n;Z:0.40", line))
            .string();
    const Outcome outcome = run({"dry-run", file, "--profile", files.profile});
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("bad.gcode") && Contains(";"));
    return outcome.err;
  };
  CHECK_THAT(refused("M112"), Contains("M112"));
  CHECK_THAT(refused("M0"), Contains("M0"));
  CHECK_THAT(refused("G1 X500 Y10 E1"), Contains("line"));
}

TEST_CASE("Options and layers that make no sense with a slicer's G-code are refused, and plan as well") {
  const Files files(few_layers());
  CHECK_THAT(files.dry_run({"--layers", "0:1"}).err, Contains("--layers") && Contains("slicer"));
  const Outcome plan =
      run({"plan", files.file, "--profile", files.profile, "-o", files.folder / "out.gcode"});
  CHECK(plan.code == 2);
  CHECK_THAT(plan.err, Contains("sliced already") && Contains("dry-run"));
  const std::string model = files.folder.write("plate.svg", test::sample_drawing).string();
  const Outcome tower = run({"dry-run", model, "--profile", files.profile, "--no-tower"});
  CHECK(tower.code == 2);
  CHECK_THAT(tower.err, Contains("--no-tower") && Contains("only for a slicer's G-code"));
}

}  // namespace unicursal
