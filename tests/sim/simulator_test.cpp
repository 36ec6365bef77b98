// The simulator in a process of its own, at the other end of a real pseudo-terminal.
#include <catch2/catch.hpp>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "child.hpp"
#include "folder.hpp"
#include "sim/bed/raster.hpp"
#include "sim/nozzle/chamber.hpp"

using namespace unicursal::sim;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

json read_json(const fs::path& file) {
  return json::parse(std::ifstream(file));
}

std::vector<std::string> small_print() {
  std::vector<std::string> commands{"M109 S205",  "G28",        "G90",     "M83", "M163 S0 P1",
                                    "M163 S1 P1", "M163 S2 P2", "M164 S3", "T3",  "G1 Z0.2 F600"};
  for (int layer = 1; layer <= 2; ++layer) {
    commands.push_back(fmt::format("G1 Z{:.1f}", 0.2 * layer));
    commands.push_back("G0 X50 Y50 F6000");
    for (int i = 0; i < 40; ++i) {
      const double x = i % 4 < 2 ? 70 : 50;
      commands.push_back(fmt::format("G1 X{} Y{} E{:.4f} F1500", x, 50 + 0.45 * ((i + 1) / 2),
                                     i % 2 == 0 ? 0.7484 : 0.0168));
    }
  }
  commands.push_back("M400");
  return commands;
}

}  // namespace

namespace {

double volume_of(const RasterFrame& frame, RasterReader& reader) {
  double volume = 0;
  std::vector<RasterPixel> row(frame.columns);
  for (std::uint64_t y = 0; y < frame.rows; ++y) {
    reader.read_row(row);
    for (const RasterPixel& pixel : row) volume += pixel.fill * frame.pixel_area() * frame.height;
  }
  return volume;
}

}  // namespace

TEST_CASE("a print over a pseudo-terminal executes every line once, in order, in spite of a damaged one") {
  const Folder folder;
  SimulatorOptions options;
  options.once = true;
  options.report = folder.path() / "report.json";
  options.pictures = folder.path() / "pictures";
  options.rasters = folder.path() / "rasters";
  const auto commands = small_print();
  Child child(options);
  {
    Host host(child.path());
    host.expect("start");
    host.expect("Marlin 2.1.2.1");
    host.stream(commands, 0, 36);
    host.write("N37 G1 X50*1\n");
    host.expect("Error:checksum mismatch, Last Line: 36");
    host.expect("Resend: 37");
    host.expect("ok");
    host.stream(commands, 36, commands.size());
  }
  REQUIRE(child.wait() == 0);

  const json report = read_json(*options.report);
  CHECK(report["lines"]["accepted"] == commands.size());
  CHECK(report["lines"]["checksum_errors"] == 1);
  CHECK(report["lines"]["resends"] == 1);
  CHECK(report["lines"]["lost_bytes"] == 0);
  CHECK(report["lines"]["unknown"] == 0);
  CHECK(report["executed_lines_in_order"] == true);
  CHECK(report["last_line"] == commands.size());
  CHECK(report["warnings"].empty());
  REQUIRE(report["layers"].size() == 2);
  CHECK(report["layers"][1]["height"].get<double>() == Approx(0.2));
  CHECK(report["layers"][0]["beads"] >= 40);
  const json& chamber = report["chamber"];
  const double capacity = Chamber({}, 3).content()[0];
  for (std::size_t f = 0; f < 3; ++f) {
    const double left = chamber["content_mm3"][f].get<double>() - capacity;
    CHECK(chamber["fed_mm3"][f].get<double>() ==
          Approx(chamber["deposited_mm3"][f].get<double>() + left).epsilon(1e-6));
  }
  CHECK(report["layers"][1]["travels"] == 1);
  const double asked = 2 * 20 * (0.7484 + 0.0168);
  CHECK(report["extruded_mm"].get<double>() == Approx(asked).epsilon(1e-4));
  REQUIRE(report["mixtures"].size() == 1);
  CHECK(report["mixtures"][0]["tool"] == 3);
  CHECK(report["mixtures"][0]["factors"] == json({16384, 16384, 32768}));
  const double feeder_3 = report["mixtures"][0]["feeder_steps"][2];
  CHECK(feeder_3 == Approx(asked * 400 / 2).margin(2));
  CHECK(report["printing_seconds"].get<double>() > 2 * 20 * 20 / 25.0);
  for (const char* name : {"deposit-0000.png", "part.png", "motion.png"}) {
    CHECK(fs::exists(*options.pictures / name));
  }
  CHECK(report["motion"]["starvations"] == 0);
  RasterReader reader(::open(options.rasters->c_str(), O_RDONLY));
  for (std::size_t layer = 0; layer < 2; ++layer) {
    const auto frame = reader.next();
    REQUIRE(frame);
    CHECK(frame->height == Approx(report["layers"][layer]["height"].get<double>()));
    CHECK(volume_of(*frame, reader) ==
          Approx(report["layers"][layer]["volume_mm3"].get<double>()).epsilon(1e-6));
  }
  CHECK_FALSE(reader.next());
  CHECK(fs::exists(*options.pictures / "deposit-0001.png"));
  CHECK_FALSE(fs::exists(*options.pictures / "deposit-0002.png"));
}

TEST_CASE("the same bytes give the same report") {
  const Folder folder;
  std::array<json, 2> reports;
  for (std::size_t i = 0; i < 2; ++i) {
    SimulatorOptions options;
    options.once = true;
    options.report = folder.path() / "report.json";
    Child child(options);
    Host host(child.path());
    host.stream(small_print());
    host.hang_up();
    REQUIRE(child.wait() == 0);
    reports[i] = read_json(*options.report);
  }
  CHECK(reports[0] == reports[1]);
}

TEST_CASE("a link to the terminal comes and goes, and never replaces a file") {
  const Folder folder;
  SimulatorOptions options;
  options.link = folder.path() / "printer";
  SECTION("a new link is removed at the end") {
    Child child(options);
    CHECK(fs::read_symlink(*options.link) == child.path());
    Host host(*options.link);
    host.write("M105\n");
    host.expect("ok T:25.00 /0.00 B:25.00 /0.00 @:0 B@:0");
    CHECK(child.stop() == 0);
    CHECK_FALSE(fs::exists(fs::symlink_status(*options.link)));
  }
  SECTION("a dangling link is replaced") {
    fs::create_symlink(folder.path() / "gone", *options.link);
    Child child(options);
    CHECK(fs::read_symlink(*options.link) == child.path());
  }
  SECTION("a file stays") {
    std::ofstream(*options.link) << "precious";
    Child child(options);
    CHECK(child.wait() == 7);
    CHECK(fs::file_size(*options.link) == 8);
  }
  SECTION("a link to a file stays") {
    std::ofstream(folder.path() / "precious") << "precious";
    fs::create_symlink(folder.path() / "precious", *options.link);
    Child child(options);
    CHECK(child.wait() == 7);
    CHECK(fs::read_symlink(*options.link) == folder.path() / "precious");
  }
}

TEST_CASE("a printer outlives its hosts: the next host finds it as the last one left it") {
  const Folder folder;
  SimulatorOptions options;
  options.report = folder.path() / "report.json";
  Child child(options);
  for (int visit = 1; visit <= 5; ++visit) {
    Host host(child.path());
    const std::string position = host.ask(fmt::format("G1 X{}\nM114\n", 10 * visit), "X:");
    CHECK(position.starts_with(fmt::format("X:{}.00", 10 * visit)));
  }
  CHECK(child.stop() == 0);
  CHECK(read_json(*options.report)["position"]["x"] == 50.0);
}

TEST_CASE("the bytes of a host that leaves at once are still executed") {
  const Folder folder;
  SimulatorOptions options;
  options.once = true;
  options.report = folder.path() / "report.json";
  Child child(options);
  {
    Host host(child.path());
    host.write("G91\nG1 X7\n");
  }
  CHECK(child.wait() == 0);
  CHECK(read_json(*options.report)["position"]["x"] == 7.0);
}

TEST_CASE("a stopped simulator writes its report") {
  const Folder folder;
  SimulatorOptions options;
  options.report = folder.path() / "report.json";
  Child child(options);
  Host host(child.path());
  host.write("M112\n");
  host.expect("//action:poweroff");
  CHECK(child.stop() == 0);
  CHECK(read_json(*options.report)["killed"] == true);
}

TEST_CASE("impossible options are refused") {
  SimulatorOptions options;
  SECTION("without a feeder") {
    options.feeders = 0;
  }
  SECTION("a bed without height") {
    options.bed = {200, 200};
  }
  SECTION("a speed of 0") {
    options.max_speed[1] = 0;
  }
  SECTION("pixels of size 0") {
    options.pixel = 0;
  }
  CHECK_THROWS_AS(run_simulator(options, [](const std::string&) {}), std::invalid_argument);
}

TEST_CASE("a report that cannot be written is refused before anything starts") {
  SimulatorOptions options;
  options.report = "/nonexistent/folder/report.json";
  Child child(options);
  CHECK(child.path().empty());
  CHECK(child.wait() == 7);
}

TEST_CASE("with a paced clock replies arrive at their printer time") {
  SimulatorOptions options;
  options.speed = 50;
  Child child(options);
  Host host(child.path());
  host.expect("start");
  const auto start = std::chrono::steady_clock::now();
  host.write("G4 S19\nM105\n");
  int busy = 0;
  std::string line;
  while (!line.starts_with("ok T:")) {
    line = host.read_line();
    busy += line == "echo:busy: processing";
  }
  // Never early; how late depends on the computer.
  CHECK(std::chrono::steady_clock::now() - start >= std::chrono::milliseconds(19000 / 50));
  CHECK(busy == 9);
}
