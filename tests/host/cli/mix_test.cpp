// `unicursal mix`, run as a real process.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/firmware_gcode/support/sliced_block.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using gcode::test::Style;
using test::Outcome;
using test::run;
using test::TempFolder;

struct Desk {
  Desk() {
    std::string text = test::sample_profile;
    const auto bed = text.find("bed = [");
    text.replace(bed, text.find(']', bed) + 1 - bed, "bed = [200, 200, 200]");
    profile = folder.write("wide.toml", text).string();
    folder.write("bench.toml", test::sample_profile);
  }
  std::string sliced(const gcode::test::BlockOptions& options) {
    return folder.write("part.gcode", gcode::test::sliced_block(options).text).string();
  }
  std::string output() const { return (folder / "mixed.gcode").string(); }

  TempFolder folder;
  std::string profile;
};

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("mix writes a file whose tools are mixtures, and says what comes out", "[sliced]") {
  Desk desk;
  const std::string file = desk.sliced({Style::prusaslicer, 2, 6});
  const Outcome outcome = run({"mix", file, "--profile", desk.profile, "-o", desk.output(), "--report",
                               (desk.folder / "mixed.json").string()});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK_THAT(outcome.out, Catch::Contains("written:") && Catch::Contains("PrusaSlicer 2.7.1"));
  const std::string text = test::read_text(desk.output());
  CHECK(count(text, ";LAYER_CHANGE\n") == 6);
  CHECK(count(text, "M164 S") >= 3);
  CHECK(text.find("M164 S") < text.find("G28"));
  CHECK(text.find(";TYPE:External perimeter\n") != std::string::npos);
  // The block alternates, so that the tool changes once a layer, and the mixture twelve times at most with
  // pulses.
  CHECK(count(text, "\nT0\n") >= 3);
  CHECK(count(text, "\nT1\n") >= 3);
  const auto report = nlohmann::json::parse(test::read_text(desk.folder / "mixed.json"));
  CHECK(report.at("command") == "mix");
  CHECK(report.at("layer_count") == 6);
}

TEST_CASE("mix refuses what is not a slicer's file, and leaves no output behind", "[sliced]") {
  Desk desk;
  desk.folder.write("plate.svg", test::sample_drawing);
  const std::string job = desk.folder.write("job.toml", test::sample_job).string();
  const Outcome not_sliced = run({"mix", job, "-o", desk.output()});
  CHECK(not_sliced.code == 2);
  CHECK_THAT(not_sliced.err,
             Catch::Contains("is not a slicer's G-code") && Catch::Contains("unicursal plan"));
  const std::string stops = desk.folder.write("stops.gcode", "M109 S200\nG28\nM600\n").string();
  const Outcome waits = run({"mix", stops, "--profile", desk.profile, "-o", desk.output()});
  CHECK(waits.code == 2);
  CHECK_THAT(waits.err, Catch::Contains("stops.gcode: line 3: M600 waits for a person") &&
                            Catch::Contains("--allow-stops"));
  CHECK(!std::filesystem::exists(desk.output()));
  const std::string file = desk.sliced({Style::cura, 2, 2});
  const Outcome same = run({"mix", file, "--profile", desk.profile, "-o", file});
  CHECK(same.code == 2);
  CHECK_THAT(same.err, Catch::Contains("same file"));
}

TEST_CASE("mix leaves a wipe tower out on request", "[sliced]") {
  Desk desk;
  gcode::test::BlockOptions options{Style::prusaslicer, 2, 4};
  options.tower = options.ramming = true;
  const std::string file = desk.sliced(options);
  const Outcome with = run({"mix", file, "--profile", desk.profile, "-o", desk.output()});
  REQUIRE(with.code == 0);
  CHECK(test::read_text(desk.output()).find("X180") != std::string::npos);
  const Outcome without = run({"mix", file, "--profile", desk.profile, "-o", desk.output(), "--no-tower"});
  REQUIRE(without.code == 0);
  CHECK(test::read_text(desk.output()).find("X180") == std::string::npos);
}

}  // namespace unicursal
