// The vocabulary of replies: what a firmware says, line by line, as typed values.
// Forms of Marlin 2.1 and Repetier 1.0.4 as observed (sim/README.md, "Marlin 2.1" and "Repetier"). Text from
// a printer is hostile input: every byte sequence parses to something, nothing is trusted, numbers are
// bounded.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace unicursal::gcode {

/// °C; what a line did not say is absent.
struct Temperatures {
  std::optional<double> nozzle, nozzle_target, bed, bed_target;

  bool empty() const { return !nozzle && !bed; }
  friend bool operator==(const Temperatures&, const Temperatures&) = default;
};

namespace reply {

/// A command was taken: "ok", "ok N2 P14 B3" (Marlin), "ok 12" (Repetier), "ok T:25.00 /0.00 …" (M105).
struct Ok {
  std::optional<std::uint32_t> line;
  std::optional<std::uint32_t> planner_places, command_places;
  Temperatures temperatures;
};
/// "Resend: 4", "Resend:2", "rs 4": the next line that the firmware wants.
struct Resend {
  std::uint32_t line = 0;
};
/// "Error:…", "fatal:…". `last_line` is what ", Last Line: 3" says; `halted` when only a reset helps.
struct Error {
  std::string text;
  std::optional<std::uint32_t> last_line;
  bool halted = false;
};
/// The board has started, that is, it has forgotten everything.
struct Start {};
/// "echo:busy: processing", "busy:processing": alive, at work.
struct Busy {
  bool for_user = false;  ///< "paused for user": somebody has to come
};
/// Repetier, every idle second.
struct Wait {};
/// Repetier has dropped a repeated line.
struct Skip {
  std::optional<std::uint32_t> line;
};
/// " T:24.1 /210.0 B:23.9 /60.0 @:127 W:?" without an ok; `waiting` when a heating command says so by "W:".
struct TemperatureReport {
  Temperatures temperatures;
  bool waiting = false;
};
/// "//action:pause" and the like.
struct Action {
  std::string text;
};
/// "FIRMWARE_NAME:…", the answer to M115.
struct Firmware {
  std::string text;
};
/// "Cap:AUTOREPORT_TEMP:1", of the same answer.
struct Capability {
  std::string name;
  bool on = false;
};
/// "echo:…"; `unknown_command` when the firmware did not understand a line (Repetier says so without
/// "echo:").
struct Echo {
  std::string text;
  bool unknown_command = false;
};
/// "X:0.00 Y:0.00 Z:0.00 E:0.00 Count X:0 …", the answer to M114 and to G28.
struct Position {
  std::string text;
  std::optional<std::array<double, 3>> mm;  ///< x y z, if all of them are told
};
struct Blank {};
/// Anything else, noise included.
struct Unknown {
  std::string text;
};

}  // namespace reply

using Reply = std::variant<reply::Ok, reply::Resend, reply::Error, reply::Start, reply::Busy, reply::Wait,
                           reply::Skip, reply::TemperatureReport, reply::Action, reply::Firmware,
                           reply::Capability, reply::Echo, reply::Position, reply::Blank, reply::Unknown>;

/// One line without its newline; spaces and carriage returns around it do not matter. Never throws.
Reply parse_reply(std::string_view line);

}  // namespace unicursal::gcode
