// Line numbers and checksums, judged when a line is received and in the order in which Marlin 2.1 does it:
// number first, then checksum. The checksum is the exclusive or of every byte before the last `*`. Repetier
// compares numbers modulo 65536, and takes the last forty for repeated ones.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace unicursal::sim {

struct LineVerdict {
  enum class Kind {
    accepted,
    repeated,      ///< one of the last numbers again: not to be executed
    wrong_number,  ///< not the last number + 1
    wrong_checksum,
    no_checksum,  ///< a number, but no checksum
  };
  Kind kind = Kind::accepted;
  std::optional<std::int64_t> number;  ///< of a numbered line
  std::string body;                    ///< an accepted line without number and checksum
};

/// What a firmware that errs takes a sound line for.
enum class Misreading {
  none,
  damaged,
  misnumbered,
  unchecked,
  forgotten,  ///< it takes the line and does not know it afterwards
};

class LineCheck {
 public:
  enum class Rules { marlin, repetier };

  explicit LineCheck(Rules rules = Rules::marlin) : rules_(rules) {}

  LineVerdict check(std::string_view line);

  std::int64_t last() const { return last_; }  ///< the number accepted last
  void set_last(std::int64_t number) { last_ = number; }

 private:
  LineVerdict::Kind judge(std::string_view line, std::int64_t number, bool resets) const;
  bool follows(std::int64_t number) const;
  bool repeats(std::int64_t number) const;

  Rules rules_;
  std::int64_t last_ = 0;
};

std::uint8_t checksum(std::string_view bytes);
/// The sentence that follows "Error:" for a refused line, with the number of the last good one.
std::string refusal(LineVerdict::Kind kind, std::int64_t last);

}  // namespace unicursal::sim
