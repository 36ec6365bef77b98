// The commands with valid input, run as real processes.
#include <poll.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "host/files/web_files.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "tests/paths.hpp"

namespace unicursal {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run;
using test::TempFolder;

/// A folder with the sample job in it.
struct Workshop {
  Workshop() {
    folder.write("bench.toml", test::sample_profile);
    folder.write("plate.svg", test::sample_drawing);
    job = folder.write("job.toml", test::sample_job).string();
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }

  TempFolder folder;
  std::string job;
};

json read_json(const std::filesystem::path& file) {
  return json::parse(test::read_text(file));
}

bool is_png(const std::filesystem::path& file) {
  const std::string bytes = test::read_text(file);
  return bytes.rfind("\x89PNG\r\n\x1a\n", 0) == 0 && bytes.find("IEND") != std::string::npos;
}

/// Width and height, pixels.
std::pair<unsigned, unsigned> png_size(const std::filesystem::path& file) {
  const std::string bytes = test::read_text(file);
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(i));
    return value;
  };
  return {number(16), number(20)};
}

/// Finds a simulator by its profile, which lies in the folder of the test.
bool simulator_runs_on(const std::string& folder) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    if (test::read_text(entry.path() / "cmdline").find(folder) != std::string::npos) return true;
  }
  return false;
}

/// The middle of a picture on the bed, mm; `place`: left, top and side of a pixel.
std::pair<double, double> middle_of(const std::filesystem::path& file, const json& place) {
  const auto [width, height] = png_size(file);
  return {place[0].get<double>() + width * place[2].get<double>() / 2,
          place[1].get<double>() - height * place[2].get<double>() / 2};
}

}  // namespace

TEST_CASE("Help succeeds") {
  for (const char* command : {"dry-run", "plan", "print", "curve", "simulate", "tune", "ports"}) {
    const Outcome outcome = run({command, "--help"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("Example:\n  unicursal " + std::string(command)) != std::string::npos);
  }
  CHECK(run({"ports"}).code == 0);
}

TEST_CASE("A dry run prints the whole part on the simulator, and its report says so") {
  const Workshop shop;
  const Outcome outcome =
      run({"dry-run", shop.job, "--report", shop.path("r.json"), "--picture", shop.path("pics")});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const json report = read_json(shop.path("r.json"));
  CHECK(report["ended"] == "completed");
  REQUIRE(report["layers"].size() == 2);
  for (const json& layer : report["layers"]) {
    CHECK(layer["area_mm2"].get<double>() == Approx(320).epsilon(1e-6));
    CHECK(layer["self_intersections"] == 0);
    CHECK(layer["outside_segments"] == 0);
  }
  // 12 of the 20 mm are sea, the rest sun; 2 layers of 0.2 mm.
  CHECK(report["mixtures"][0]["part_mm3"].get<double>() == Approx(192 * 0.4).epsilon(0.02));
  CHECK(report["mixtures"][0]["part_mm3"].get<double>() + report["mixtures"][1]["part_mm3"].get<double>() ==
        Approx(320 * 0.4).epsilon(1e-6));
  CHECK(report["totals"]["mean_spacing_mm"].get<double>() == Approx(1).epsilon(0.03));
  const json& comparison = report["comparison"];
  CHECK(comparison["lines_lost"] == 0);
  CHECK(comparison["lines_twice"] == 0);
  CHECK(comparison["lines_in_order"] == true);
  for (const json& mixture : comparison["mixtures"]) {
    CHECK(mixture["relative_error"].get<double>() == Approx(0).margin(0.005));
  }
  CHECK(report["simulator"]["layers"].size() == 2);
  const json& laid = report["laid"];
  REQUIRE(laid["layers"].size() == 2);
  CHECK(laid["total"]["area_mm2"].get<double>() == Approx(640).epsilon(0.01));
  CHECK(laid["total"]["gap_fraction"].get<double>() < 0.05);
  CHECK(laid["total"]["overfill_fraction"].get<double>() < 0.05);
  CHECK(laid["total"]["mixture"]["wrong_mm2"].get<double>() > 0);  // because the chamber answers late
  CHECK(laid["total"]["mixture"]["wrong_mm2"].get<double>() < 4 * 6.1 / 0.2);
  const json& chamber = report["simulator"]["chamber"];
  double fed = 0, deposited = 0, content = 0;
  for (std::size_t f = 0; f < 3; ++f) {
    fed += chamber["fed_mm3"][f].get<double>();
    deposited += chamber["deposited_mm3"][f].get<double>();
    content += chamber["content_mm3"][f].get<double>();
  }
  const double full = 2.1 + 2 * 4.0 / 4.743865;  // two tanks; 95 % of them have passed at 4.74 tank volumes
  CHECK(fed == Approx(deposited + content - full).epsilon(1e-6));
  CHECK(report["motion"]["starvations"] == 0);
  CHECK(report["motion"]["nominal_flow"] == 3.0);
  CHECK(report["motion"]["mean_speed"].get<double>() > 5);
  CHECK_FALSE(report.contains("peak_memory_mib"));  // it differs from run to run
  for (const char* name : {"curve-0000.png", "curve-0001.png", "deposit-0000.png", "deposit-0001.png",
                           "gaps-0001.png", "mixtures-0000.png", "part.png", "motion.png"}) {
    INFO(name);
    CHECK(is_png(shop.folder / ("pics/" + std::string(name))));
  }
  for (const json& place : laid["worst"]) CHECK(place["area_mm2"].get<double>() > 0);
  CHECK(laid["worst"].size() == 3);
  if (!host::web_files().empty()) {
    const std::string page = test::read_text(shop.path("pics/index.html"));
    const std::size_t begin = page.find('{');
    const json view = json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    CHECK(view["gaps"]["fraction"] == laid["total"]["gap_fraction"]);
    REQUIRE(view["layers"].size() == 2);
    // All four pictures have the part in their middle.
    for (const json& layer : view["layers"]) {
      const std::string number = "-000" + std::to_string(layer["layer"].get<int>()) + ".png";
      CHECK(layer["deposit"] == layer["layer"]);
      const auto [x, y] = middle_of(shop.path("pics/gaps" + number), layer["place"]);
      for (const std::string kind : {"curve", "deposit"}) {
        const auto middle = middle_of(shop.path("pics/" + kind + number), view["places"][kind]);
        CHECK(middle.first == Approx(x).margin(0.5));
        CHECK(middle.second == Approx(y).margin(0.5));
      }
    }
  }
  CHECK(std::filesystem::exists(shop.path("pics/index.html")) == !host::web_files().empty());
  CHECK(outcome.out.find("0 lines lost") != std::string::npos);
  CHECK_FALSE(simulator_runs_on(shop.folder.path().string()));
}

TEST_CASE("A range of layers is printed on the bed") {
  const Workshop shop;
  REQUIRE(run({"dry-run", shop.job, "--layers", "1:1", "--report", shop.path("r.json")}).code == 0);
  const json report = read_json(shop.path("r.json"));
  REQUIRE(report["layers"].size() == 1);
  CHECK(report["layers"][0]["layer"] == 1);
  CHECK(report["layers"][0]["top_mm"].get<double>() == Approx(0.2));
  CHECK(report["simulator"]["layers"][0]["z"].get<double>() == Approx(0.2));
}

TEST_CASE("A thin line deposits its width times its length") {
  const Workshop shop;
  shop.folder.write("job.toml", test::replaced(test::sample_job, "flow = 3.0", "deposit = { width = 0.5 }"));
  REQUIRE(run({"plan", shop.job, "-o", shop.path("o.gcode"), "--report", shop.path("r.json")}).code == 0);
  const json report = read_json(shop.path("r.json"));
  double volume = 0;
  for (const json& mixture : report["mixtures"]) volume += mixture["part_mm3"].get<double>();
  CHECK(volume == Approx(0.5 * 0.2 * report["totals"]["length_mm"].get<double>()));
}

TEST_CASE("A plan has the lines that a dry run sends, and is the same twice") {
  const Workshop shop;
  REQUIRE(run({"plan", shop.job, "-o", shop.path("a.gcode"), "--report", shop.path("r.json")}).code == 0);
  REQUIRE(run({"plan", shop.job, "-o", shop.path("b.gcode")}).code == 0);
  const std::string text = test::read_text(shop.path("a.gcode"));
  CHECK(text == test::read_text(shop.path("b.gcode")));
  REQUIRE(run({"dry-run", shop.job, "--report", shop.path("d.json")}).code == 0);
  std::size_t commands = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) commands += !line.empty() && line[0] != ';';
  CHECK(read_json(shop.path("r.json"))["lines"] == commands);
  constexpr std::size_t questions = 6;  // M163, M105, two T and M105 first; M155 at the end
  const std::size_t sent = read_json(shop.path("d.json"))["link"]["lines"];
  // Before that G4 and M105, once a second until the nozzle cools.
  REQUIRE(sent > commands + questions);
  CHECK((sent - commands - questions) % 2 == 0);
  CHECK(sent - commands - questions <= 20);
}

TEST_CASE("The three files of a curve agree with its report") {
  const Workshop shop;
  const Outcome outcome =
      run({"curve", shop.job, "--layer", "1", "-o", shop.path("c.txt"), "-o", shop.path("c.svg"), "-o",
           shop.path("c.png"), "--report", shop.path("r.json")});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const json report = read_json(shop.path("r.json"));
  std::vector<std::array<double, 3>> rows;
  std::istringstream text(test::read_text(shop.path("c.txt")));
  for (std::array<double, 3> row{}; text >> row[0] >> row[1] >> row[2];) rows.push_back(row);
  CHECK(report["vertices"] == rows.size());
  double area = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto &a = rows[i], &b = rows[(i + 1) % rows.size()];
    area += a[2] * std::hypot(b[0] - a[0], b[1] - a[1]);
    CHECK((a[0] >= 0 && a[0] <= 20 && a[1] >= 0 && a[1] <= 16));  // the part's frame
  }
  CHECK(area == Approx(report["island_area_mm2"].get<double>()).epsilon(1e-9));
  CHECK(is_png(shop.folder / "c.png"));
  CHECK(test::read_text(shop.path("c.svg")).find("</svg>") != std::string::npos);
}

TEST_CASE("A curve's stages are six pictures of one size, and the bytes do not depend on the threads") {
  const Workshop shop;
  const std::string pictures = shop.path("stages");
  const Outcome outcome = run({"curve", shop.job, "--picture", pictures, "-o", shop.path("1.txt")});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  std::set<std::string> contents;
  for (const char* name : {"1-field.png", "2-graph.png", "3-first-cycle.png", "4-optimised-cycle.png",
                           "5-curve.png", "6-width.png"}) {
    INFO(name);
    const std::filesystem::path file = std::filesystem::path(pictures) / name;
    REQUIRE(is_png(file));
    // 14 pixels a bead of 1 mm and a margin of 8 around the plate of 20 × 16 mm; 34 for the caption.
    CHECK(png_size(file) == std::pair<unsigned, unsigned>(420, 16 * 14 + 16 + 34));
    contents.insert(test::read_text(file));
  }
  CHECK(contents.size() == 6);
  REQUIRE(run({"curve", shop.job, "--threads", "3", "-o", shop.path("3.txt")}).code == 0);
  CHECK(test::read_text(shop.path("3.txt")) == test::read_text(shop.path("1.txt")));
  // A file in the way of the folder.
  const Outcome refused = run({"curve", shop.job, "--picture", shop.job});
  CHECK(refused.code == 2);
  CHECK(refused.err.find(shop.job) != std::string::npos);
}

TEST_CASE("The number of threads does not change the plan, and must be a number") {
  const Workshop shop;
  REQUIRE(
      run({"plan", shop.job, "--threads", "1", "-o", shop.path("1.gcode"), "--report", shop.path("r.json")})
          .code == 0);
  REQUIRE(run({"plan", shop.job, "--threads", "3", "-o", shop.path("3.gcode")}).code == 0);
  CHECK(test::read_text(shop.path("3.gcode")) == test::read_text(shop.path("1.gcode")));
  CHECK(read_json(shop.path("r.json"))["planning"]["threads"] == 1);
  for (const char* number : {"0", "-1", "two", "1e9"}) {
    const Outcome outcome = run({"plan", shop.job, "--threads", number, "-o", shop.path("x.gcode")});
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("--threads") != std::string::npos);
  }
}

TEST_CASE("A simulator in a process of its own takes a print") {
  const Workshop shop;
  test::Child simulator(
      {"simulate", "--once", "--link", shop.path("printer"), "--report", shop.path("seen.json")});
  while (!std::filesystem::exists(shop.path("printer"))) {
    REQUIRE(simulator.running());
    poll(nullptr, 0, 5);
  }
  const Outcome outcome =
      run({"print", shop.job, "--port", shop.path("printer"), "--report", shop.path("r.json")});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);  // otherwise the simulator would wait for a host forever
  CHECK(simulator.wait().code == 0);
  CHECK(read_json(shop.path("seen.json"))["last_line"] == read_json(shop.path("r.json"))["link"]["lines"]);
}

TEST_CASE("Messages never go into a file or to a printer, even if the standard streams are closed") {
  const Workshop shop;
  const std::string script = "exec 0<&- 1>&- 2>&-; exec \"" + test::program() + "\" dry-run \"" + shop.job +
                             "\" --report \"" + shop.path("r.json") + "\"";
  const int code = std::system(script.c_str());
  CHECK(WEXITSTATUS(code) == 0);
  const json report = read_json(shop.path("r.json"));
  CHECK(report["simulator"]["lines"]["unknown"] == 0);
  CHECK(report["ended"] == "completed");
}

TEST_CASE("A serial log cannot replace another file of the print") {
  const Workshop shop;
  const std::string before = test::read_text(shop.job);
  CHECK(run({"dry-run", shop.job, "--log", shop.job}).code == 2);
  CHECK(run({"print", shop.job, "--log", shop.path("bench.toml"), "--port", shop.path("none")}).code == 2);
  CHECK(run({"doctor", "--profile", shop.path("bench.toml"), "--log", shop.path("bench.toml")}).code == 2);
  CHECK(run({"dry-run", shop.job, "--log", shop.path("r"), "--report", shop.path("r")}).code == 2);
  CHECK(test::read_text(shop.job) == before);
  CHECK(test::read_text(shop.path("bench.toml")) == test::sample_profile);
}

TEST_CASE("A simulator moves no faster than its profile's axes") {
  const TempFolder folder;
  const std::string link = (folder / "printer").string(), report = (folder / "seen.json").string();
  const std::string limits = GENERATE("", "max_speed = [20, 150, 10]");
  const auto profile =
      folder.write("bench.toml", test::replaced(test::sample_profile, "[extruder]", limits + "\n[extruder]"));
  test::Child simulator(
      {"simulate", "--once", "--profile", profile.string(), "--link", link, "--report", report});
  while (!std::filesystem::exists(link)) {
    REQUIRE(simulator.running());
    poll(nullptr, 0, 5);
  }
  const int port = open(link.c_str(), O_RDWR | O_NOCTTY);
  REQUIRE(port >= 0);
  const std::string words = "G1 X100 F7200\nM400\n";
  REQUIRE(write(port, words.data(), words.size()) == static_cast<ssize_t>(words.size()));
  close(port);
  REQUIRE(simulator.wait().code == 0);
  const double seconds = read_json(report)["printer_seconds"];
  CHECK((seconds > 100 / 20.0) == !limits.empty());
}

TEST_CASE("Ctrl-C parks and cools, and the simulator ends with its host") {
  const Workshop shop;
  test::Child host({"dry-run", shop.job, "--speed", "60", "--report", shop.path("r.json")});
  while (host.err().find("layer 1 of 2") == std::string::npos) {
    REQUIRE(host.running());
    poll(nullptr, 0, 20);
  }
  kill(host.id(), SIGINT);
  const Outcome outcome = host.wait();
  INFO(outcome.err);
  CHECK(outcome.code == 3);
  const json report = read_json(shop.path("r.json"));
  CHECK(report["ended"] == "stopped");
  CHECK(report["simulator"]["temperatures"]["nozzle"]["target"] == 0);
  // A stop during heating is confirmed by a query that the link adds.
  CHECK(report["simulator"]["last_line"] >= report["link"]["lines"]);
  CHECK(report["simulator"]["executed_lines_in_order"] == true);
  CHECK_FALSE(simulator_runs_on(shop.folder.path().string()));
}

TEST_CASE("A full output does not end a print") {
  const Workshop shop;
  test::Child host({"dry-run", shop.job, "--report", shop.path("r.json")}, "/dev/full");
  CHECK(host.wait().code == 0);
  CHECK(read_json(shop.path("r.json"))["ended"] == "completed");
}

TEST_CASE("A closed terminal ends a print as Ctrl-C does") {
  const Workshop shop;
  test::Child host({"dry-run", shop.job, "--speed", "60", "--report", shop.path("r.json")});
  while (host.err().find("layer 1 of 2") == std::string::npos) {
    REQUIRE(host.running());
    poll(nullptr, 0, 20);
  }
  kill(host.id(), SIGHUP);
  kill(host.id(), SIGHUP);  // the shell sends it as well
  CHECK(host.wait().code == 3);
  const json report = read_json(shop.path("r.json"));
  CHECK(report["ended"] == "stopped");
  CHECK(report["simulator"]["temperatures"]["nozzle"]["target"] == 0);
}

TEST_CASE("Devices and links are written to, not replaced") {
  const Workshop shop;
  const auto link = shop.folder / "link.json", real = shop.folder / "real.json";
  std::filesystem::create_symlink("real.json", link);  // dangling at first
  for (int round = 0; round < 2; ++round) {
    REQUIRE(run({"plan", shop.job, "-o", "/dev/null", "--report", link.string()}).code == 0);
    CHECK(std::filesystem::is_symlink(link));
    CHECK(read_json(real)["ended"] == "completed");
  }
  CHECK(std::filesystem::is_character_file("/dev/null"));
  CHECK_FALSE(std::filesystem::exists("/dev/null.part"));
}

TEST_CASE("A print whose report cannot be written has failed, with code 1") {
  const Workshop shop;
  const Outcome outcome = run({"dry-run", shop.job, "--report", "/dev/full"});
  INFO(outcome.err);
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("the print was completed, but its report is lost") != std::string::npos);
}

}  // namespace unicursal
