#include "firmware_gcode/reply/reply.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "core/text/printable.hpp"

using namespace unicursal::gcode;

namespace {

template <class What>
What parsed(std::string_view line) {
  const Reply result = parse_reply(line);
  INFO(line);
  REQUIRE(std::holds_alternative<What>(result));
  return std::get<What>(result);
}

}  // namespace

TEST_CASE("oks of both firmwares") {
  CHECK_FALSE(parsed<reply::Ok>("ok").line);
  CHECK_FALSE(parsed<reply::Ok>(" ok\r").line);
  const auto advanced = parsed<reply::Ok>("ok N2 P14 B3");
  CHECK(advanced.line == 2u);
  CHECK(advanced.planner_places == 14u);
  CHECK(advanced.command_places == 3u);
  const auto unnumbered = parsed<reply::Ok>("ok P15 B3");
  CHECK_FALSE(unnumbered.line);
  CHECK(unnumbered.planner_places == 15u);
  CHECK(parsed<reply::Ok>("ok 12").line == 12u);
  const auto heat = parsed<reply::Ok>("ok T:25.00 /0.00 B:24.50 /60.00 @:0 B@:0");
  CHECK_FALSE(heat.line);
  CHECK(heat.temperatures == Temperatures{25.0, 0.0, 24.5, 60.0});
  CHECK_FALSE(parsed<reply::Ok>("ok N99999999999").line);
}

TEST_CASE("a line that only resembles an ok is not an ok") {
  for (const char* line : {"okay", "ok:", "nok", "OK", "o", "okok"}) {
    CHECK(std::holds_alternative<reply::Unknown>(parse_reply(line)));
  }
}

TEST_CASE("resend requests") {
  CHECK(parsed<reply::Resend>("Resend: 4").line == 4);
  CHECK(parsed<reply::Resend>("Resend:2").line == 2);
  CHECK(parsed<reply::Resend>("rs 7").line == 7);
  for (const char* line : {"Resend:", "Resend: x", "Resend: -3", "Resend: 4x", "Resend: 99999999999"}) {
    CHECK(std::holds_alternative<reply::Unknown>(parse_reply(line)));
  }
}

TEST_CASE("errors report the last line, or a halt") {
  const auto mismatch = parsed<reply::Error>("Error:checksum mismatch, Last Line: 3");
  CHECK(mismatch.last_line == 3u);
  CHECK_FALSE(mismatch.halted);
  CHECK(parsed<reply::Error>("Error:No Checksum with line number, Last Line: 2").last_line == 2u);
  CHECK(parsed<reply::Error>("Error:Line Number is not Last Line Number+1, Last Line: 0").last_line == 0u);
  CHECK(parsed<reply::Error>("Error:Printer halted. kill() called!").halted);
  CHECK(parsed<reply::Error>("fatal: heater/sensor error").halted);
  CHECK_FALSE(parsed<reply::Error>("Error:Last Line: none").last_line);
}

TEST_CASE("temperatures") {
  const auto report = parsed<reply::TemperatureReport>(" T:182.13 /210.00 B:60.02 /60.00 @:127 B@:30 W:?");
  CHECK(report.temperatures == Temperatures{182.13, 210.0, 60.02, 60.0});
  CHECK(report.waiting);
  const auto repetier = parsed<reply::TemperatureReport>("T:25.0 B:24.0");
  CHECK(repetier.temperatures == Temperatures{25.0, {}, 24.0, {}});
  CHECK_FALSE(repetier.waiting);
  CHECK(parsed<reply::TemperatureReport>("T:-12.5 /0.0").temperatures.nozzle == -12.5);
  CHECK(std::holds_alternative<reply::Unknown>(parse_reply("T:nan /inf")));
}

TEST_CASE("the rest of the vocabulary") {
  parsed<reply::Start>("start");
  parsed<reply::Wait>("wait");
  CHECK_FALSE(parsed<reply::Busy>("echo:busy: processing").for_user);
  CHECK_FALSE(parsed<reply::Busy>("busy:processing").for_user);
  CHECK(parsed<reply::Busy>("echo:busy: paused for user").for_user);
  CHECK(parsed<reply::Busy>("echo:busy: paused for input").for_user);
  CHECK(parsed<reply::Skip>("skip 1").line == 1u);
  CHECK(parsed<reply::Action>("//action:out_of_filament T0").text == "out_of_filament T0");
  CHECK(parsed<reply::Echo>("echo:Unknown command: \"M9999\"").unknown_command);
  CHECK_FALSE(parsed<reply::Echo>("echo: cold extrusion prevented").unknown_command);
  CHECK(parsed<reply::Firmware>("FIRMWARE_NAME:Marlin 2.1.2").text == "FIRMWARE_NAME:Marlin 2.1.2");
  parsed<reply::Blank>("");
  parsed<reply::Blank>(" \r");
  parsed<reply::Position>("X:0.00 Y:0.00 Z:0.00 E:0.00 Count X:0 Y:0 Z:0");
  parsed<reply::Unknown>("restart");
}

TEST_CASE("any bytes parse to some value and can be shown") {
  std::mt19937 random(11);
  const std::vector<std::string> starts = {
      "", "ok ", "ok N", "Resend:", "Error:", "T:", " T:1 /", "echo:", "skip "};
  for (int i = 0; i < 100000; ++i) {
    std::string line = starts[random() % starts.size()];
    for (auto n = random() % 40; n > 0; --n) line += static_cast<char>(random() % 256);
    parse_reply(line);
    for (char c : unicursal::core::printable(line)) REQUIRE((c >= ' ' && c <= '~'));
  }
}

TEST_CASE("RepRapFirmware's replies are understood") {
  const auto heat = parsed<reply::Ok>("ok T:24.7 /210.0 T0:24.7 /210.0 B:23.9 /60.0");
  CHECK(heat.temperatures == Temperatures{24.7, 210.0, 23.9, 60.0});
  CHECK(parsed<reply::Ok>("ok T0:24.7 /0.0 B:23.9 /0.0").temperatures == Temperatures{24.7, 0.0, 23.9, 0.0});
  CHECK_FALSE(parsed<reply::TemperatureReport>("T:24.7 /0.0 T0:24.7 /0.0 B:23.9 /0.0").waiting);
  const auto place = parsed<reply::Position>(
      "X:1.000 Y:2.500 Z:0.200 E:0.000 E0:3.1 E1:0.2 E2:0.2 Count 80 200 80 Machine 1.000 2.500 0.200 Bed "
      "comp 0.000");
  CHECK(place.mm == std::array<double, 3>{1, 2.5, 0.2});
  parsed<reply::Start>("RepRapFirmware for Duet 2 WiFi/Ethernet is up and running.");
  CHECK(parsed<reply::Echo>("Warning: M155: Command is not supported").unknown_command);
  CHECK(parsed<reply::Echo>("Error: Bad command: xyz").unknown_command);
  CHECK_FALSE(parsed<reply::Echo>("Warning: the 12V rail is low").unknown_command);
  CHECK_FALSE(parsed<reply::Error>("Error: M567: Invalid tool number").halted);
  CHECK(parsed<reply::Error>("Error: G1: Machine is halted").halted);
  CHECK(parsed<reply::Resend>("rs 12").line == 12);
}
