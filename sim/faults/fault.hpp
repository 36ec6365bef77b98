// Faults as a user writes them: KIND[:VALUE][@MOMENT]. sim/README.md lists all kinds (section Faults).
//
//   bitflip:1e-4          one byte in ten thousand to the printer has one bit wrong
//   lostok@line=120       the next ok after line N120 was received never comes
//   stall:5@t=60          one minute after power-up the firmware stops reading and answering for 5 s
//   say://action:pause@command=G28
//
// A moment is `t=SECONDS` of printer time, `line=NUMBER` when that numbered line is first received, or
// `command=WORD` whenever a line with that command is received. A kind with a chance needs a chance or a
// moment; with a moment it strikes at its next occasion, once for each time that the moment comes. `slow` and
// `slowboot` take no moment. Every other kind needs one, `silentwork` and `chattywork` that of a command; the
// occasion of `answer` is the next ok. A file holds one fault on each line, blank lines, comments after `#`,
// and `seed NUMBER`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace unicursal::sim {

enum class FaultKind {
  // Occasion: each byte to the printer.
  bit_flip,
  lost_byte,
  // Occasion: each byte from the printer.
  reply_flip,
  lost_reply,
  // Occasion: each line to the printer.
  merged_lines,
  false_alarm,
  false_number,
  false_missing,
  rewind,
  // Occasion: each reply.
  lost_ok,
  double_ok,
  broken_ok,
  other_ok,
  lost_resend,
  double_resend,
  glued_ok,
  noise,
  bad_utf8,
  nul,
  slow,
  slow_boot,  // no occasion
  // These strike at a moment.
  stall,
  silence,
  disconnect,
  reset,
  heater_failure,
  bed_failure,
  unguarded,
  runaway,
  thermistor,
  runout,
  filament_change,
  say,
  display,
  fatal,
  stopped,
  silent_work,
  chatty_work,
};

struct Fault {
  FaultKind kind{};
  double chance = 0;                   ///< Probability at every occasion.
  double seconds = 0;                  ///< Duration; 0 = for ever if the cable is pulled. Maximum for `slow`.
  std::string text;                    ///< Text to say, or to replace an ok.
  std::optional<double> time;          ///< Moment: s since power-up.
  std::optional<std::int64_t> line;    ///< Moment: line number.
  std::optional<std::string> command;  ///< Moment: command, "G28".

  bool has_moment() const { return time || line || command; }
};

struct FaultPlan {
  std::vector<Fault> faults;
  std::uint64_t seed = 1;
};

/// The name that a user writes.
std::string_view name(FaultKind kind);
/// One line for each kind: its name and its effect.
std::string fault_help();

/// Read faults. All throw std::invalid_argument with a sentence; read_faults() also throws
/// std::system_error if it cannot read the file.
Fault parse_fault(std::string_view text);
FaultPlan parse_faults(std::string_view text, const std::string& file);
FaultPlan read_faults(const std::filesystem::path& file);

}  // namespace unicursal::sim
