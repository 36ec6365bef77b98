// Commands on models, run as real processes.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "tests/host/support/terminal.hpp"

namespace unicursal {
namespace {

using Catch::Matchers::Contains;
using test::Outcome;
using test::run;
using test::TempFolder;

/// Two boxes of 8 x 8 x 1 mm, one of them `gap` mm above the other, as facets of an STL file.
std::string boxes(double gap) {
  std::string text = "solid two\n";
  for (const double z : {0.0, 1 + gap}) {
    static constexpr const char* facets[] = {"023", "031", "457", "476", "015", "054",
                                             "267", "273", "046", "062", "137", "175"};
    for (const char* facet : facets) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (int k = 0; k < 3; ++k) {
        const int corner = facet[k] - '0';
        text += "vertex " + std::to_string(corner % 2 * 8) + ' ' + std::to_string(corner / 2 % 2 * 8) + ' ' +
                std::to_string(z + corner / 4) + '\n';
      }
      text += "endloop\nendfacet\n";
    }
  }
  return text + "endsolid\n";
}

}  // namespace

TEST_CASE("A model is printed without a job") {
  const TempFolder folder;
  const std::string model = folder.write("plate.svg", test::sample_drawing).string();
  const std::string profile = folder.write("bench.toml", test::sample_profile).string();
  const Outcome with = run({"dry-run", model, "--profile", profile, "--layers", "0:0"});
  INFO(with.err);
  CHECK(with.code == 0);
  CHECK(with.err.find("note:") == std::string::npos);
  const Outcome without = run({"plan", model, "--layers", "0:0", "-o", (folder / "plate.gcode").string()});
  CHECK(without.code == 0);
  CHECK_THAT(without.err, Contains("note: no profile is named"));
  CHECK(test::read_text(folder / "plate.gcode").find("G1 ") != std::string::npos);
}

TEST_CASE("A mesh without a job or a profile is tried on a common printer, in windows of three widths",
          "[optimised]") {
  const TempFolder folder;
  const std::string model = folder.write("part.stl", boxes(-0.5)).string();
  const int width = GENERATE(60, 80, 120);
  test::Terminal terminal({"dry-run", model, "--layers", "0:0"}, "/nonexistent",
                          {static_cast<unsigned short>(width)});
  terminal.await("note: no profile is named");
  terminal.await("the print takes ");
  CHECK(terminal.wait() == 0);
}

TEST_CASE("A model is not printed on a printer that nobody has named") {
  const TempFolder folder;
  const Outcome outcome = run({"print", folder.write("plate.svg", test::sample_drawing).string()});
  CHECK(outcome.code == 2);
  CHECK_THAT(outcome.err, Contains("on which printer") && Contains("unicursal setup"));
}

TEST_CASE("Notes about a part are shown also if it is refused") {
  const TempFolder folder;
  std::string facets;
  for (const char* facet :
       {"0 0 0 0 .1 0 .1 0 0", "0 0 0 .1 0 0 0 0 .1", "0 0 0 0 0 .1 0 .1 0", ".1 0 0 0 .1 0 0 0 .1"}) {
    std::istringstream numbers(facet);
    facets += "facet normal 0 0 0\nouter loop\n";
    for (std::string x, y, z; numbers >> x >> y >> z;) facets += "vertex " + x + ' ' + y + ' ' + z + '\n';
    facets += "endloop\nendfacet\n";
  }
  const Outcome outcome = run({"plan", folder.write("small.stl", "solid\n" + facets + "endsolid\n").string(),
                               "-o", (folder / "x.gcode").string()});
  CHECK(outcome.code == 2);
  CHECK_THAT(outcome.err, Contains("note: the part is only 0.1 x 0.1 x 0.1 mm; write units = \"m\"") &&
                              Contains("nowhere wide enough"));
}

TEST_CASE("inspect lists what zones can select, what was mended, and whether it fits") {
  const TempFolder folder;
  const std::string profile = folder.write("bench.toml", test::sample_profile).string();
  const Outcome drawing =
      run({"inspect", folder.write("plate.svg", test::sample_drawing).string(), "--profile", profile});
  CHECK(drawing.code == 0);
  CHECK_THAT(drawing.out, Contains("20 x 16 mm") && Contains("\"#0000ff\"  192 mm²") &&
                              Contains("\"#ff0000\"  128 mm²") && Contains("fits:    yes"));
  const Outcome mesh = run({"inspect", folder.write("two.stl", boxes(-0.5)).string(), "--profile", profile});
  CHECK(mesh.code == 0);
  CHECK_THAT(mesh.out,
             Contains("8 x 8 x 1.5 mm") && Contains("\"body 2\"  64 mm³") && Contains("mended:  nothing"));
  const Outcome large = run({"inspect",
                             folder
                                 .write("large.svg",
                                        "<svg xmlns='http://www.w3.org/2000/svg' width='300mm' "
                                        "height='9mm' viewBox='0 0 300 9'><rect width='300' "
                                        "height='9'/></svg>")
                                 .string(),
                             "--profile", profile});
  CHECK(large.code == 2);
  CHECK_THAT(large.out, Contains("fits:    no"));
}

TEST_CASE("new writes a job that plans, and never over a file") {
  const TempFolder folder;
  folder.write("bench.toml", test::sample_profile);
  const std::string model = folder.write("plate.svg", test::sample_drawing).string(),
                    job = (folder / "job.toml").string();
  const std::vector<std::string> command{"new", model,       "-o",
                                         job,   "--profile", (folder / "bench.toml").string()};
  const Outcome outcome = run(command);
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK_THAT(outcome.out, Contains("2 zones"));
  CHECK_THAT(test::read_text(job), Contains("printer = \"bench.toml\"") && Contains("file = \"plate.svg\""));
  CHECK(run({"plan", job, "--layers", "0:0", "-o", (folder / "x.gcode").string()}).code == 0);
  CHECK(run(command).code == 2);
  CHECK(run({"new", (folder / "bench.toml").string(), "-o", (folder / "other.toml").string()}).code == 2);
}

TEST_CASE("What begins in the air is reported with its layer and place, before the print and in the report") {
  const TempFolder folder;
  const std::string profile = folder.write("bench.toml", test::sample_profile).string();
  const Outcome outcome = run({"plan", folder.write("two.stl", boxes(2)).string(), "--profile", profile, "-o",
                               (folder / "x.gcode").string(), "--report", (folder / "r.json").string()});
  CHECK(outcome.code == 0);
  CHECK_THAT(outcome.err, Contains("layers are empty from layer 3 on") &&
                              Contains("begins in the air in layer 10, at z = 3.00 mm"));
  const auto places = nlohmann::json::parse(test::read_text(folder / "r.json")).at("in_the_air");
  REQUIRE(places.size() == 2);
  CHECK(places[0].at("kind") == "empty layers");
  CHECK(places[0].at("layers") == 7);
  CHECK(places[1].at("kind") == "island");
  CHECK(places[1].at("layer") == 10);
  CHECK(places[1].at("area_mm2") == Approx(64));
  CHECK(places[1].at("x_mm") == Approx(4));
}

}  // namespace unicursal
