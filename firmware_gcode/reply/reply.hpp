// The vocabulary of replies: each line of a firmware as a typed value. The forms are those of Marlin 2.1 and
// Repetier 1.0.4 as observed (sim/README.md, "Marlin 2.1" and "Repetier"). Text from a printer is hostile
// input: every byte sequence parses to some value, nothing is trusted, and numbers are bounded.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace unicursal::gcode {

/// °C; absent if the line does not contain it.
struct Temperatures {
  std::optional<double> nozzle, nozzle_target, bed, bed_target;

  bool empty() const { return !nozzle && !bed; }
  friend bool operator==(const Temperatures&, const Temperatures&) = default;
};

namespace reply {

/// A command was accepted: "ok", "ok N2 P14 B3" (Marlin), "ok 12" (Repetier), "ok T:25.00 /0.00 …" (M105).
struct Ok {
  std::optional<std::uint32_t> line;
  std::optional<std::uint32_t> planner_places, command_places;
  Temperatures temperatures;
};
/// "Resend: 4", "Resend:2", "rs 4": the next line that the firmware expects.
struct Resend {
  std::uint32_t line = 0;
};
/// "Error:…", "fatal:…". `last_line` is the number in ", Last Line: 3"; `halted`: only a reset helps.
struct Error {
  std::string text;
  std::optional<std::uint32_t> last_line;
  bool halted = false;
};
/// The board has started and has lost its position, heat and mixtures.
struct Start {};
/// "echo:busy: processing", "busy:processing": the firmware is alive and at work.
struct Busy {
  bool for_user = false;  ///< "paused for user": the user must act
};
/// Sent by Repetier every idle second.
struct Wait {};
/// Repetier has dropped a repeated line.
struct Skip {
  std::optional<std::uint32_t> line;
};
/// " T:24.1 /210.0 B:23.9 /60.0 @:127 W:?" without an ok; `waiting`: a heating command waits ("W:").
struct TemperatureReport {
  Temperatures temperatures;
  bool waiting = false;
};
/// "//action:pause" and similar.
struct Action {
  std::string text;
};
/// "FIRMWARE_NAME:…", the answer to M115.
struct Firmware {
  std::string text;
};
/// "Cap:AUTOREPORT_TEMP:1", part of the same answer.
struct Capability {
  std::string name;
  bool on = false;
};
/// "echo:…"; `unknown_command`: the firmware did not understand a line (Repetier reports that without
/// "echo:").
struct Echo {
  std::string text;
  bool unknown_command = false;
};
/// "X:0.00 Y:0.00 Z:0.00 E:0.00 Count X:0 …", the answer to M114 and to G28.
struct Position {
  std::string text;
  std::optional<std::array<double, 3>> mm;  ///< x y z; absent unless all three are given
};
struct Blank {};
/// Any other text, including noise.
struct Unknown {
  std::string text;
};

}  // namespace reply

using Reply = std::variant<reply::Ok, reply::Resend, reply::Error, reply::Start, reply::Busy, reply::Wait,
                           reply::Skip, reply::TemperatureReport, reply::Action, reply::Firmware,
                           reply::Capability, reply::Echo, reply::Position, reply::Blank, reply::Unknown>;

/// Parses a line without its newline; ignores spaces and carriage returns around it. Never throws.
Reply parse_reply(std::string_view line);

/// Makes text safe to show and to log: bytes that are not printable ASCII become \xNN. Text longer than
/// `limit` bytes is cut and ends with an ellipsis.
std::string printable(std::string_view text, std::size_t limit = 200);

}  // namespace unicursal::gcode
