// Splits bytes into lines as Marlin's input stage does: a line ends with CR, LF or NUL; `;` starts a comment
// that extends to the end of the line (and swallows a checksum behind it), unless a backslash precedes it;
// the first 95 characters are kept, and the rest of a longer line is dropped, its checksum included.
//
// Repetier's differs in two points: `(` starts a comment as well, and a line of 96 characters without an end
// is thrown away, whereupon what follows is a line of its own (Repetier-Firmware 1.0.4, class GCode).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace unicursal::sim {

class LineAssembler {
 public:
  explicit LineAssembler(bool repetier = false) : repetier_(repetier) {}

  static constexpr std::size_t longest = 95;  ///< Characters of a line that are kept.
  static constexpr std::size_t repetier_room = 96;

  /// Returns the finished line if `byte` ends a line that is not blank.
  std::optional<std::string> push(char byte);
  /// Discards the unfinished line.
  void reset();
  bool at_line_start() const { return line_.empty() && !comment_ && !escaped_; }
  /// Whether a line was thrown away since the last call.
  bool threw_away() { return std::exchange(threw_away_, false); }

  std::uint64_t too_long() const { return too_long_; }  ///< Lines that lost characters.

 private:
  std::optional<std::string> finish();

  bool repetier_;
  std::string line_;
  bool comment_ = false, escaped_ = false, cut_ = false, threw_away_ = false;
  std::uint64_t too_long_ = 0;
};

}  // namespace unicursal::sim
