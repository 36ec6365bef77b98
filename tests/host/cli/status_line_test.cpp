#include "host/cli/status_line.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "host/cli/columns.hpp"
#include "host/cli/typed_line.hpp"
#include "host/engine/heat_forecast.hpp"
#include "host/engine/seconds.hpp"

namespace unicursal::host {
namespace {

using Catch::Matchers::Contains;

SessionStatus printing() {
  SessionStatus status;
  status.state = SessionState::printing;
  status.layer = 38;
  status.layers = 100;
  status.percent = 12.3;
  status.left = 3900;
  status.temperatures.nozzle = 205;
  status.temperatures.nozzle_target = 205;
  status.temperatures.bed = 60;
  status.temperatures.bed_target = 60;
  status.mixture = "orange";
  status.lookahead = 480;
  status.lookahead_layers = 3;
  status.queue = 0.9;
  return status;
}

/// 2026-03-04 13:00 in the zone of the test.
std::chrono::system_clock::time_point one_o_clock() {
  std::tm parts{};
  parts.tm_year = 126;
  parts.tm_mon = 2;
  parts.tm_mday = 4;
  parts.tm_hour = 13;
  parts.tm_isdst = -1;
  return std::chrono::system_clock::from_time_t(std::mktime(&parts));
}

std::string at(std::size_t width, const SessionStatus& status, const StatusLook& look = {}) {
  return status_line(status, look, width, one_o_clock());
}

}  // namespace

TEST_CASE("fields of the progress line become shorter and go by their rank, and none is cut") {
  const SessionStatus status = printing();
  CHECK(at(200, status) ==
        "printing layer 38 of 100, 12 %, 1 h 05 min left (14:05), nozzle 205/205 °C, orange, "
        "8 min 00 s planned ahead, bed 60/60 °C, queue 90 %");
  CHECK(at(119, status) ==
        "printing layer 38 of 100, 12 %, 1 h 05 min left (14:05), nozzle 205 °C, orange, 8 min 00 s ahead, "
        "bed 60 °C, queue 90 %");
  CHECK(at(79, status) == "printing layer 38/100, 12 %, 1 h 05 min left (14:05), orange, 8 min 00 s ahead");
  CHECK(at(59, status) == "printing layer 38 of 100, 12 %, 1 h 05 min left (14:05)");
  CHECK(at(54, status) == "printing layer 38/100, 12 %, 1 h 05 min left (14:05)");
  CHECK(at(40, status) == "printing, 12 %, 1 h 05 min left");
  CHECK(at(5, status) == "printing");
  for (std::size_t width = 8; width < 160; ++width) CHECK(columns(at(width, status)) <= width);
}

TEST_CASE("while it heats, temperatures have the place of layers") {
  SessionStatus status = printing();
  status.state = SessionState::heating;
  status.layer = 0;
  status.mixture.clear();
  status.temperatures.nozzle = 24;
  CHECK(at(59, status) == "heating, 1 h 05 min left (14:05), nozzle 24 °C, bed 60 °C");
  status.left = 42;
  CHECK_THAT(at(59, status), Contains("heating, 42 s left, nozzle 24/205 °C"));
}

TEST_CASE("a mixture has a swatch only where the terminal has colours") {
  const SessionStatus status = printing();
  StatusLook look;
  look.colour_of = [](const std::string& name) {
    return name == "orange" ? std::optional(picture::Colour{250, 100, 10}) : std::nullopt;
  };
  CHECK_THAT(at(79, status, look), !Contains("\x1b"));
  look.colours = TerminalLook::Colours::all;
  CHECK_THAT(at(79, status, look), Contains(", \x1b[48;2;250;100;10m  \x1b[0m orange"));
  look.colours = TerminalLook::Colours::palette;
  CHECK_THAT(at(79, status, look), Contains(", \x1b[48;5;202m  \x1b[0m orange"));
  SessionStatus hostile = status;
  hostile.mixture = "\x1b[2J";
  CHECK_THAT(at(200, hostile, look), !Contains("\x1b[2J"));
}

TEST_CASE("a dry run shows the time that it will itself take") {
  StatusLook look;
  look.dry = true;
  const SessionStatus status = printing();
  CHECK_THAT(at(79, status, look), Contains("dry run layer 38 of 100, 12 %, ") && !Contains("left"));
  look.dry_left = 12;
  CHECK_THAT(at(79, status, look),
             Contains("dry run layer 38 of 100, 12 %, 12 s left, ") && !Contains("nozzle"));
}

TEST_CASE("durations are as exact as a person needs them, and a time of another day names the day") {
  CHECK(rough_duration(0.4) == "0 s");
  CHECK(rough_duration(59.4) == "59 s");
  CHECK(rough_duration(59.6) == "1 min 00 s");
  CHECK(rough_duration(600) == "10 min");
  CHECK(rough_duration(3900) == "1 h 05 min");
  CHECK(rough_duration(100 * 3600) == "4 d 4 h");
  const auto now = one_o_clock();
  CHECK(time_of_day(now + std::chrono::minutes(65), now) == "14:05");
  CHECK(time_of_day(now + std::chrono::hours(12), now) == "Thu 01:00");
}

TEST_CASE("wide characters and combining marks have their width") {
  CHECK(columns("°C") == 2);
  CHECK(columns("橙色") == 4);
  CHECK(columns("e\u0301") == 1);
  CHECK(columns("🧡") == 2);
  CHECK(columns("\xff\xfe") == 2);
  CHECK(beginning("a橙b", 2) == "a");
  CHECK(ending("a橙b", 2) == "b");
  CHECK(ending("a橙b", 3) == "橙b");
}

TEST_CASE("a typed line knows the keys that erase, and takes others for nothing") {
  TypedLine line;
  CHECK(line.take("spe").empty());
  CHECK(line.text() == "spe");
  CHECK(line.take("ä\x7f\x7fxx\x08 \x1b[A\x1b[1;5C\x1bOP\x01") == std::vector<std::string>{});
  CHECK(line.text() == "spx ");
  line.take("\x17");
  CHECK(line.text().empty());
  CHECK(line.take("speed 90\npause\rres") == std::vector<std::string>{"speed 90", "pause"});
  line.take("\x15");
  CHECK(line.text().empty());
  line.take(std::string(5000, 'x'));
  CHECK(line.text().size() == TypedLine::longest);
}

TEST_CASE("the time until a printer is hot follows the rate at which it heats") {
  HeatForecast forecast;
  gcode::Temperatures seen;
  seen.nozzle = 20;
  seen.nozzle_target = 220;
  seen.bed = 20;
  seen.bed_target = 62;
  const auto note = [&](double at) { forecast.note(TimePoint(duration(at)), seen); };
  note(0);
  CHECK(forecast.left(220, 62) == Approx(100));  // the bed, at the usual 0.4 °C/s
  for (int second = 1; second <= 10; ++second) {
    *seen.nozzle += 2;
    *seen.bed += 1;
    note(second);
  }
  CHECK(forecast.left(220, 62) == Approx((218 - 40) / 2.0));  // the nozzle; the bed needs 30 s
  seen.nozzle_target = 0;                                     // it waits until the bed is hot
  note(11);
  CHECK(forecast.left(220, 62) > 100);
  seen.nozzle = 219;
  seen.bed = 61;
  note(12);
  CHECK(forecast.left(220, 62) == 0);
}

}  // namespace unicursal::host
