// `unicursal tune flow`: the print, the factors, and the program itself.
#include "host/tune/flow_test.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "host/job/profile.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using test::Outcome;
using test::run;

constexpr const char* machine_text = R"([printer]
bed = [200.0, 200.0, 200.0]
nozzle = 0.6
bead_width_range = [0.36, 1.6]

[extruder]
feeders = 3       # a Diamond
flow_factors = [1.3, 1.0, 0.9]
filament_diameter = 1.75

[gcode]
start = """
G29
G1 X5 E8 F600 ; purge
"""
end = """
G1 E-5 F300
M300
"""
)";

/// What the lines of a print feed through each of three feeders, as Marlin understands them, mm.
std::vector<double> fed_by(const host::FinishedPrint& print) {
  std::vector<double> shares(3), fed(3);
  std::vector<std::vector<double>> tools(16);
  std::size_t tool = 0;
  const auto take = [&](const gcode::Chunk& chunk) {
    for (const std::string& line : chunk.lines) {
      std::size_t number = 0;
      double value = 0;
      if (std::sscanf(line.c_str(), "M163 S%zu P%lf", &number, &value) == 2) shares.at(number) = value;
      if (std::sscanf(line.c_str(), "M164 S%zu", &number) == 1) tools.at(number) = shares;
      if (std::sscanf(line.c_str(), "T%zu", &number) == 1) tool = number;
      const std::size_t e = line.find(" E");
      if (line.rfind("G1", 0) != 0 || e == std::string::npos) continue;
      for (std::size_t f = 0; f < 3; ++f) fed[f] += tools.at(tool).at(f) * std::stod(line.substr(e + 2));
    }
  };
  take(print.start);
  for (const gcode::Chunk& chunk : print.body) take(chunk);
  take(print.finish);
  return fed;
}

}  // namespace

TEST_CASE("The print feeds exactly what it says it does, whatever the profile's factors are") {
  const test::TempFolder folder;
  const host::Profile profile = host::load_profile(folder.write("p.toml", machine_text));
  const host::FlowTest test = host::make_flow_test(profile.printer);
  CHECK(test.scripts_shortened);
  const std::vector<double> fed = fed_by(host::gcode_of(test.print, test.printer));
  for (std::size_t f = 0; f < 3; ++f) {
    // The numbers and the retractions, of which the last undoes the first, are in it.
    CHECK(fed[f] == Approx(test.asked[f]).margin(0.01));
    CHECK(test.asked[f] > 98);
    CHECK(test.asked[f] < 105);
  }
}

TEST_CASE("A feeder that slips gets a factor above 1, and one that no feeder can have is refused") {
  const gcode::PerFeeder factors = host::flow_factors({100, 102}, {97, 103});
  CHECK(factors[0] == Approx(1.0309).margin(0.0001));
  CHECK(factors[1] == Approx(0.9903).margin(0.0001));
  CHECK_THROWS_WITH(host::flow_factors({100, 100}, {100, 20}),
                    Catch::Contains("feeder 2") && Catch::Contains("20.0 mm"));
  CHECK_THROWS_AS(host::flow_factors({100, 100}, {100, 0}), core::DataError);
  CHECK_THROWS_AS(host::flow_factors({100, 100}, {-3, 100}), core::DataError);
}

TEST_CASE("Lines of a script that feed filament are left out, and no others") {
  CHECK(host::without_feeding("G29\nG1 X10 E5 F300 ; purge\ng1e-2\nG92 E0\nG0 X5 ; E is not meant\nM83\n") ==
        "G29\nG92 E0\nG0 X5 ; E is not meant\nM83\n");
  CHECK(host::without_feeding("G1 E{retraction_length}").empty());
  CHECK(host::without_feeding("G10 E1\nG28 ; G1 E5") == "G10 E1\nG28 ; G1 E5");
  CHECK(host::without_feeding("").empty());
}

TEST_CASE("Factors are asked for or given, and only they change in the profile", "[tuning]") {
  const test::TempFolder folder;
  const std::string profile = folder.write("p.toml", machine_text).string();
  const auto flow = [&](const std::string& answers, std::vector<std::string> more) {
    more.insert(more.begin(), {"tune", "flow", profile});
    return test::Child(more, {}, folder.write("answers", answers).string()).wait();
  };
  const host::FlowTest lines = host::make_flow_test(host::load_profile(profile).printer);
  SECTION("asked") {
    const Outcome outcome = flow("21.5\nmuch\n19,0\n20\ny\n", {});
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.find("a number from 0 to 120") != std::string::npos);
    const gcode::PerFeeder factors = host::load_profile(profile).printer.flow_factors;
    CHECK(factors[0] == Approx(lines.asked[0] / 98.5).margin(0.0006));
    CHECK(factors[1] == Approx(lines.asked[1] / 101).margin(0.0006));
    CHECK(factors[2] == Approx(lines.asked[2] / 100).margin(0.0006));
    const std::string text = test::read_text(profile);
    CHECK(text.find("feeders = 3       # a Diamond\nflow_factors = [") != std::string::npos);
    CHECK(text.find("filament_diameter = 1.75\n") != std::string::npos);
  }
  SECTION("given, with another mark") {
    const Outcome outcome = flow("", {"--mark", "150", "--measured", "50, 51,49.5", "--yes"});
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(host::load_profile(profile).printer.flow_factors[1] == Approx(lines.asked[1] / 99).margin(0.0006));
  }
  SECTION("cancelled") {
    for (const char* answers : {"", "q\n", "21\n", "21\n19\nq\n", "21\n19\n20\n", "21\n19\n20\nn\n"}) {
      CAPTURE(answers);
      CHECK(flow(answers, {}).code == 1);
      CHECK(test::read_text(profile) == machine_text);
    }
  }
  SECTION("wrong") {
    const std::vector<std::vector<std::string>> wrong = {{"--measured", "20,20", "--yes"},
                                                         {"--measured", "20,20,x", "--yes"},
                                                         {"--measured", "20,20,115", "--yes"},
                                                         {"--measured", "20,20,nan", "--yes"},
                                                         {"--mark", "20"},
                                                         {"-o", profile}};
    for (const auto& more : wrong) {
      const Outcome outcome = flow("", more);
      INFO(outcome.out << outcome.err);
      CHECK(outcome.code == 2);
      CHECK(test::read_text(profile) == machine_text);
    }
  }
  SECTION("a mark that would go into its feeder") {
    std::string wide = test::replaced(machine_text, "nozzle = 0.6", "nozzle = 1.2");
    wide = test::replaced(wide, "[0.36, 1.6]", "[0.8, 3.0]");
    folder.write("p.toml", wide);
    const Outcome outcome = flow("", {"--mark", "110", "--measured", "2,2,2", "--yes"});
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("and add --mark 114") != std::string::npos);
    CHECK(test::read_text(profile) == wide);
    CHECK(flow("", {"--mark", "114", "--measured", "6,6,6", "--yes"}).code == 0);
  }
  SECTION("written to a file") {
    const std::string file = (folder / "flow.gcode").string();
    const Outcome outcome = flow("", {"-o", file});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("120 mm before its feeder") != std::string::npos);
    const std::string gcode = test::read_text(file);
    CHECK(gcode.find("\nG29\n") != std::string::npos);
    CHECK(gcode.find("X5 E8") == std::string::npos);
    CHECK(gcode.find("\nM300\n") != std::string::npos);
    CHECK(gcode.find("E-5 F300") == std::string::npos);
  }
}

}  // namespace unicursal
