// Splits bytes into lines as Marlin's input stage does: a line ends with CR, LF or NUL; `;` starts a comment
// that extends to the end of the line (and swallows a checksum behind it), unless a backslash precedes it;
// the first 95 characters are kept, and the rest of a longer line is dropped, its checksum included.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace unicursal::sim {

class LineAssembler {
 public:
  /// `brackets`: `(` starts a comment as well, as in Repetier.
  explicit LineAssembler(bool brackets = false) : brackets_(brackets) {}

  static constexpr std::size_t longest = 95;  ///< Characters of a line that are kept.

  /// Returns the finished line if `byte` ends a line that is not blank.
  std::optional<std::string> push(char byte);
  /// Discards the unfinished line.
  void reset();

  std::uint64_t too_long() const { return too_long_; }  ///< Lines that lost characters.

 private:
  std::optional<std::string> finish();

  bool brackets_;
  std::string line_;
  bool comment_ = false, escaped_ = false, cut_ = false;
  std::uint64_t too_long_ = 0;
};

}  // namespace unicursal::sim
