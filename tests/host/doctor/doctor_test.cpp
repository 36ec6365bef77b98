// What `unicursal doctor` finds: the program itself, and printers that answer as real ones do.
#include <poll.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "firmware_gcode/reply/identity.hpp"
#include "host/doctor/examine.hpp"
#include "host/doctor/findings.hpp"
#include "tests/host/link/fake_printer.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using namespace unicursal::host;
using nlohmann::json;
using test::FakePrinter;

namespace {

/// Answers beyond "ok", by command.
test::FakeBehaviour answering(std::map<std::string, std::vector<std::string>> answers) {
  test::FakeBehaviour behaviour;
  behaviour.instead = [answers](FakePrinter& printer, std::size_t, const std::string& command) {
    const auto answer = answers.find(command.substr(0, command.find(' ')));
    if (answer == answers.end()) return false;
    for (const std::string& line : answer->second) printer.reply(line);
    return true;
  };
  return behaviour;
}

const std::vector<std::string> settings = {
    "echo:; Steps per unit:",
    "echo:  M92 X80.00 Y80.00 Z400.00 E93.00",
    "echo:; Maximum feedrates (units/s):",
    "echo:  M203 X150.00 Y150.00 Z10.00 E25.00",
    "echo:  M201 X1000.00 Y1000.00 Z100.00 E10000.00",
    "echo:  M200 S1 D1.75",
    "ok",
};

const std::vector<std::string> unknown = {"echo:Unknown command: \"…\"", "ok"};

std::string weight_of(const json& found, const std::string& part) {
  for (const json& finding : found["findings"]) {
    if (finding["text"].get<std::string>().find(part) != std::string::npos) return finding["weight"];
  }
  return "nothing";
}

}  // namespace

TEST_CASE("doctor: settings are read from the lines of M503, in the forms of any Marlin") {
  const MachineSettings now = settings_in(settings);
  CHECK(now.steps_per_mm == std::array<double, 4>{80, 80, 400, 93});
  CHECK(now.max_speed == std::array<double, 4>{150, 150, 10, 25});
  CHECK(now.max_acceleration == std::array<double, 4>{1000, 1000, 100, 10000});
  CHECK(now.volumetric == true);
  const MachineSettings old = settings_in({"  M92 X80 Y80 Z400 E93", "echo:Filament settings: M200 D0"});
  CHECK(old.steps_per_mm == std::array<double, 4>{80, 80, 400, 93});
  CHECK(old.volumetric == false);
  const MachineSettings damaged = settings_in({"M92", "M203 X Y Z E", "M201 X1 Y2", "xM200 S1", "M2000 S1"});
  CHECK_FALSE(damaged.steps_per_mm);
  CHECK_FALSE(damaged.max_speed);
  CHECK_FALSE(damaged.max_acceleration);
  CHECK_FALSE(damaged.volumetric);
}

TEST_CASE("doctor: a printer's defects are reported, and nothing moves or heats") {
  const test::TempFolder folder;
  const std::string profile = folder.write("bench.toml", test::sample_profile).string();
  FakePrinter printer(answering({{"M503", settings}, {"M163", unknown}, {"M85", unknown}}));
  const test::Outcome outcome =
      test::run({"doctor", "--port", printer.path(), "--profile", profile, "--json"});
  printer.stop();
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 2);
  const json found = json::parse(outcome.out);
  CHECK(found["family"] == "Marlin");
  CHECK(found["version"] == "2.1.2");
  CHECK(found["mixes"] == false);
  CHECK(weight_of(found, "do not mix") == "trouble");
  CHECK(weight_of(found, "volumetric") == "trouble");
  CHECK(weight_of(found, "M85") == "warning");
  CHECK(weight_of(found, "115200 baud carry only 288 lines") == "warning");
  CHECK(found["max_acceleration"][0] == 1000);
  for (const std::string& line : printer.executed()) {
    const std::string command = line.substr(0, line.find(' '));
    CHECK((command == "M163" || command == "M85" || command == "M503"));
  }
}

TEST_CASE("doctor: a sound printer is reported as sound") {
  std::vector<std::string> sound = settings;
  std::erase_if(sound, [](const std::string& line) { return line.find("M200") != std::string::npos; });
  auto behaviour = answering({{"M503", sound}});
  behaviour.advanced = true;
  FakePrinter printer(behaviour);
  const test::Outcome outcome = test::run({"doctor", "--port", printer.path(), "--baud", "250000"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("Marlin 2.1.2.1 (fake)") == 0);
  CHECK(outcome.out.find("trouble") == std::string::npos);
  CHECK(outcome.out.find("its feeders mix") != std::string::npos);
  CHECK(outcome.out.find("15 moves") != std::string::npos);
}

TEST_CASE("doctor: a profile with higher limits than the printer is reported") {
  Examination found;
  found.mixes = true;
  found.tells_settings = true;
  found.settings = settings_in(settings);
  Profile profile;
  profile.printer.max_acceleration = {1500, 900, 100};
  profile.printer.max_speed = {150, 150, 10};
  std::string text;
  for (const Finding& finding : findings(found, 250000, &profile)) text += finding.text + "\n";
  CHECK(text.find("max_acceleration for x is 1000 mm/s², the profile says 1500") != std::string::npos);
  CHECK(text.find("its max_speed is not below that of the profile") != std::string::npos);
}

TEST_CASE("doctor: the virtual tools of a printer are counted, and its settings read") {
  const auto [who, tools] = GENERATE(table<std::string, int>({{"marlin", 16}, {"marlin-few-tools", 2}}));
  const test::TempFolder folder;
  const std::string port = folder / "port";
  test::Child simulator({"simulate", "--once", "--personality", who, "--link", port});
  while (!std::filesystem::exists(port)) {
    REQUIRE(simulator.running());
    poll(nullptr, 0, 5);
  }
  const test::Outcome outcome = test::run({"doctor", "--port", port, "--json"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  const json found = json::parse(outcome.out);
  CHECK(found["virtual_tools"] == tools);
  CHECK(weight_of(found, "virtual tools") == (tools == 16 ? "good" : "warning"));
  CHECK(found["steps_per_mm"][2] == 400);
}

TEST_CASE("doctor: a Repetier with other feeders than the profile's is refused") {
  Examination found;
  found.mixes = true;
  found.identity = gcode::identify("FIRMWARE_NAME:Repetier_1.0.4 EXTRUDER_COUNT:4");
  CHECK(has_trouble(findings(found, 250000, nullptr)));  // three are usual
  Profile profile;
  profile.printer.firmware = "repetier";
  profile.printer.feeders = 4;
  CHECK_FALSE(has_trouble(findings(found, 250000, &profile)));
  profile.printer.feeders = 5;
  CHECK(has_trouble(findings(found, 250000, &profile)));
}

TEST_CASE("doctor: without a printer it says so in a sentence") {
  FakePrinter silent({.inwards = [](const std::string&) { return std::string(); }, .boots = false});
  const test::Outcome outcome = test::run({"doctor", "--port", "/dev/no-such-port"});
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("this port does not exist") != std::string::npos);
}
