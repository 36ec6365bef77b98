// What Marlin 2.1 reports of its settings (settings.cpp and the G-code files of the same names), and the
// commands that only answer.
#include <algorithm>

#include <fmt/format.h>

#include "sim/firmware/firmware.hpp"

namespace unicursal::sim {

namespace {

std::string in_words(const PerAxis<double>& values) {
  return fmt::format("X{:.2f} Y{:.2f} Z{:.2f} E{:.2f}", values[axis_x], values[axis_y], values[axis_z],
                     values[axis_e]);
}

bool names_axis(const Command& command) {
  return command.has('X') || command.has('Y') || command.has('Z') || command.has('E');
}

constexpr double longest_keepalive = 60;  // s

}  // namespace

std::string Firmware::setting(int code) const {
  const MotionLimits& limits = planner_.limits();
  switch (code) {
    case 92:
      return "M92 " + in_words(limits.steps_per_mm);
    case 201:
      return "M201 " + in_words(limits.max_acceleration);
    case 203:
      return "M203 " + in_words(limits.max_speed);
    case 204:
      return fmt::format("M204 P{:.2f} R{:.2f} T{:.2f}", limits.print_acceleration,
                         limits.retract_acceleration, limits.travel_acceleration);
    case 205:
      return fmt::format("M205 B20000.00 S0.00 T0.00 {}",
                         limits.junction_deviation > 0 ? fmt::format("J{:.3f}", limits.junction_deviation)
                                                       : in_words(limits.jerk));
    default:
      return "M301 P22.20 I1.08 D114.00";
  }
}

/// A setting without values reports them; returns whether it was one.
bool Firmware::only_asks(const Command& command) {
  const bool asks = command.code() == 204
                        ? !command.has('S') && !command.has('P') && !command.has('R') && !command.has('T')
                        : !names_axis(command) && !command.has('J');
  if (asks && personality_.family == Personality::Family::marlin) say("echo:  " + setting(command.code()));
  return asks;
}

void Firmware::report_settings(const Command&) {
  say("echo:; Linear Units:");
  say("echo:  G21 ; (mm)");
  say("echo:; Temperature Units:");
  say("echo:  M149 C ; Units in Celsius");
  say("echo:; Filament settings (Disabled):");
  say("echo:  M200 S0 D1.75");
  for (const int code : {92, 203, 201, 204, 205, 301}) say("echo:  " + setting(code));
}

/// M502 and, without an EEPROM, M501.
void Firmware::load_settings(const Command&) {
  planner_.limits() = original_limits();
  say("echo:Hardcoded Default Settings Loaded");
}

void Firmware::store_settings(const Command&) {
  say("Error:EEPROM disabled");
}

void Firmware::keepalive(const Command& command) {
  if (const auto seconds = command.value('S')) busy_interval_ = std::clamp(*seconds, 0.0, longest_keepalive);
  say(fmt::format("echo:M113 S{:.0f}", busy_interval_));
}

void Firmware::pid(const Command&) {
  say("echo: " + setting(301).substr(5));
}

void Firmware::cold_extrusion(const Command& command) {
  const bool given = command.has('S') || command.has('P');
  if (const auto least = command.value('S')) cold_ = *least;
  if (command.has('P')) cold_ = command.value_or('P', 1) > 0 ? 0 : personality_.cold;
  if (given) return;
  say(fmt::format("echo:Cold extrudes are {}abled (min temp {:.2f}C)", cold_ > 0 ? "dis" : "en", cold_));
}

void Firmware::soft_endstops(const Command&) {
  say(fmt::format("echo:Soft endstops: On  Min:  X{:.2f} Y{:.2f} Z0.00   Max:  X{:.2f} Y{:.2f} Z{:.2f}",
                  0 - machine_.overtravel[0], 0 - machine_.overtravel[1], machine_.bed[0], machine_.bed[1],
                  machine_.bed[2]));
}

/// M118 A1 E1 TEXT
void Firmware::echo_text(const Command&) {
  std::string_view text = queue_.front().body;
  text.remove_prefix(std::min(text.find_first_not_of("M118"), text.size()));
  std::string prefix;
  const auto take = [&](std::string_view flag, const char* shown) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (!text.starts_with(flag)) return;
    text.remove_prefix(flag.size());
    prefix += shown;
  };
  take("A1", "//");
  take("E1", "echo:");
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  say(prefix + std::string(text));
}

void Firmware::print_time(const Command&) {
  say("echo:Print time: 0s");
}

void Firmware::endstops(const Command&) {
  say("Reporting endstop status");
  for (const Axis axis : {axis_x, axis_y, axis_z}) {
    const bool pressed = coordinates_.place()[axis] <= 0;
    say(fmt::format("{}_min: {}", "xyz"[axis], pressed ? "TRIGGERED" : "open"));
  }
}

}  // namespace unicursal::sim
