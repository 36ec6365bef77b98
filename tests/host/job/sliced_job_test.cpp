// Jobs that print a slicer's G-code: their keys, and the mixtures of its tools.
#include "host/job/sliced_job.hpp"

#include <catch2/catch.hpp>

#include "host/engine/prepared_sliced.hpp"
#include "host/job/load_job.hpp"
#include "host/job/sliced_file.hpp"
#include "tests/firmware_gcode/support/sliced_block.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using namespace unicursal::host;
using Catch::Matchers::Contains;

namespace {

constexpr const char* plain = "printer = \"bench.toml\"\n[part]\nfile = \"block.gcode\"\n";

class Folder {
 public:
  explicit Folder(const gcode::test::BlockOptions& options = {}) {
    folder.write("bench.toml", test::sample_profile);
    folder.write("block.gcode", gcode::test::sliced_block(options).text);
  }
  Job load(const std::string& text) const { return load_job(folder.write("job.toml", text)); }
  PreparedSliced prepare(const std::string& text) const { return prepare_sliced(load(text)); }
  /// What a job is refused with.
  std::string refused(const std::string& text) const {
    try {
      prepare(text);
    } catch (const core::DataError& error) {
      return error.what();
    }
    return "";
  }
  test::TempFolder folder;
};

gcode::Mixture mixture(double a, double b, double c) {
  return gcode::Mixture({a, b, c});
}

const gcode::Mixture& of_tool(const PreparedSliced& prepared, int tool) {
  return prepared.job.print.materials.at(prepared.job.sliced->tools.at(tool)).mixture;
}

}  // namespace

TEST_CASE("The endings of G-code are known, and binary G-code is refused with what to switch off") {
  for (const char* name : {"a.gcode", "a.GCODE", "a.gco", "a.g", "a.gc"}) CHECK(is_sliced_file(name));
  for (const char* name : {"a.bgcode", "a.stl", "gcode", "a.gcode.toml"}) CHECK_FALSE(is_sliced_file(name));
  CHECK_THROWS_WITH(load_job_or_model("a.bgcode", {}, UnnamedPrinter::assume_common_frame),
                    Contains("binary G-code") && Contains("switch off"));
}

TEST_CASE("Tools without a zone get the mixture nearest to their colour, others what the job says") {
  const Folder folder;
  const PreparedSliced by_colour = folder.prepare(plain);
  CHECK(by_colour.job.sliced->tools.size() == 2);
  CHECK_FALSE(of_tool(by_colour, 0) == of_tool(by_colour, 1));  // red and green
  const PreparedSliced chosen =
      folder.prepare(std::string(plain) +
                     "[[zone]]\nselect = \"T1\"\nmixture = \"sun\"\n[mixture]\nsun = [0.0, 1.0, 1.0]\n");
  CHECK(of_tool(chosen, 1) == mixture(0, 1, 1));
  CHECK(of_tool(chosen, 0) == of_tool(by_colour, 0));
}

TEST_CASE("Without colours each tool has a feeder of its own, and then from the first again") {
  gcode::test::BlockOptions options;
  options.style = gcode::test::Style::kisslicer;
  options.tools = 4;
  options.stripe = 10;
  const PreparedSliced prepared = Folder(options).prepare(plain);
  CHECK(of_tool(prepared, 0) == mixture(1, 0, 0));
  CHECK(of_tool(prepared, 1) == mixture(0, 1, 0));
  CHECK(of_tool(prepared, 2) == mixture(0, 0, 1));
  CHECK(of_tool(prepared, 3) == mixture(1, 0, 0));
  CHECK(prepared.job.print.materials.size() == 3);
}

TEST_CASE("Keys that make no sense with a slicer's G-code are refused with a sentence") {
  const Folder folder;
  const std::string text = plain;
  CHECK_THAT(folder.refused(text + "layer_height = 0.2\n"),
             Contains("part.layer_height") && Contains("sliced"));
  CHECK_THAT(folder.refused(text + "bead_width = 0.5\n"), Contains("part.bead_width"));
  const std::string zone =
      text + "[mixture]\nsun = [0.0, 1.0, 1.0]\n[[zone]]\nselect = \"T0\"\nmixture = \"sun\"\n";
  CHECK(folder.refused(zone).empty());
  CHECK_THAT(folder.refused(zone + "pattern = \"none\"\n"), Contains("zone[0].pattern"));
  CHECK_THAT(folder.refused(test::replaced(zone, "T0", "T7")), Contains("T7") && Contains("T0, T1"));
  CHECK_THAT(folder.refused(test::replaced(zone, "T0", "#ff0000")), Contains("zone[0].select"));
  CHECK_THAT(folder.refused(zone + "[[zone]]\nselect = \"T0\"\nmixture = \"sun\"\n"),
             Contains("second time"));
  CHECK_THAT(folder.refused(text + "tower = 1\n"), Contains("part.tower"));
}

TEST_CASE("Keys of a slicer's G-code are refused for a model") {
  const Folder folder;
  folder.folder.write("plate.svg", test::sample_drawing);
  const std::string text = test::replaced(test::sample_job, "flow = 3.0", "flow = 3.0\ntower = false");
  CHECK_THROWS_WITH(folder.load(text), Contains("part.tower") && Contains("only for a slicer's G-code"));
}

TEST_CASE("A written job names each tool with its mixture, and is the same job") {
  const Folder folder;
  const Profile profile = load_profile(folder.folder / "bench.toml");
  const std::string file = folder.folder / "block.gcode";
  const gcode::SlicedSurvey survey = survey_of(file, profile.printer, false);
  const std::string text = sliced_job(file, survey, profile, folder.folder.path());
  CHECK_THAT(text, Contains("select = \"T0\"") && Contains("select = \"T1\"") && Contains("#tower = false"));
  const PreparedSliced written = folder.prepare(text), usual = folder.prepare(plain);
  for (const int tool : {0, 1}) {
    for (std::size_t f = 0; f < 3; ++f)
      CHECK(of_tool(written, tool).share(f) == Approx(of_tool(usual, tool).share(f)));
  }
}
