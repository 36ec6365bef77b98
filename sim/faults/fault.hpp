// What shall go wrong, as a user writes it: KIND[:VALUE][@MOMENT].
//
//   bitflip:1e-4          one byte in ten thousand on its way to the printer has one bit wrong
//   lostok@line=120       the next ok after line N120 was received never comes
//   stall:5@t=60          a minute after power-up the firmware stops reading and answering for 5 s
//   say://action:pause@command=G28
//
// A moment is `t=SECONDS` of printer time, `line=NUMBER` when that numbered line is first received, or
// `command=WORD` whenever a line with that command is. A kind that has a chance needs that or a moment (it
// then strikes at its next occasion, once for every time that the moment comes); every other kind needs a
// moment, also `answer`, whose occasion is the next ok. A file holds one fault on each line, blank lines,
// comments from `#` on, and `seed NUMBER`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace unicursal::sim {

enum class FaultKind {
  // each byte to the printer
  bit_flip,
  lost_byte,
  // each byte from the printer
  reply_flip,
  lost_reply,
  // each line to the printer
  merged_lines,
  false_alarm,
  false_number,
  false_missing,
  rewind,
  // each reply
  lost_ok,
  double_ok,
  broken_ok,
  other_ok,
  lost_resend,
  double_resend,
  noise,
  bad_utf8,
  nul,
  slow,
  // at a moment
  stall,
  silence,
  disconnect,
  reset,
  heater_failure,
  bed_failure,
  runaway,
  thermistor,
  runout,
  say,
  fatal,
};

struct Fault {
  FaultKind kind{};
  double chance = 0;                   ///< at every occasion
  double seconds = 0;                  ///< of a stall, a disconnection (0: for ever), at most of a slow reply
  std::string text;                    ///< to be said, or what an ok is to be instead
  std::optional<double> time;          ///< s since power-up
  std::optional<std::int64_t> line;    ///< number
  std::optional<std::string> command;  ///< "G28"

  bool has_moment() const { return time || line || command; }
};

struct FaultPlan {
  std::vector<Fault> faults;
  std::uint64_t seed = 1;
};

/// The name that a user writes.
std::string_view name(FaultKind kind);
/// One line for each kind: its name and what it does.
std::string fault_help();

/// These throw std::invalid_argument with a sentence; read_faults std::system_error for a file it cannot
/// read.
Fault parse_fault(std::string_view text);
FaultPlan parse_faults(std::string_view text, const std::string& file);
FaultPlan read_faults(const std::filesystem::path& file);

}  // namespace unicursal::sim
