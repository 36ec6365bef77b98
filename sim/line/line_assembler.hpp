// Bytes to lines, as Marlin's input stage does it: a line ends with CR or LF; `;` starts a comment that
// reaches to the end of the line (and swallows a checksum behind it); a backslash keeps the byte behind it
// from starting one; 95 characters are kept and the rest of a longer line is dropped, its checksum included.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace unicursal::sim {

class LineAssembler {
 public:
  static constexpr std::size_t longest = 95;  ///< characters kept of a line

  /// Returns the finished line when `byte` ends one that holds anything but spaces.
  std::optional<std::string> push(char byte);
  /// Forgets the line begun.
  void reset();

  std::uint64_t too_long() const { return too_long_; }  ///< lines that lost characters

 private:
  std::optional<std::string> finish();

  std::string line_;
  bool comment_ = false, escaped_ = false, cut_ = false;
  std::uint64_t too_long_ = 0;
};

}  // namespace unicursal::sim
