// Line numbers and checksums, judged when a line is received and in the order in which Marlin 2.1 does it:
// number first, then checksum. The checksum is the exclusive or of every byte before the last `*`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace unicursal::sim {

struct LineVerdict {
  enum class Kind {
    accepted,
    repeated,      ///< the last or last-but-one number again: to be dropped without an answer
    wrong_number,  ///< not the last number + 1
    wrong_checksum,
    no_checksum,  ///< a number, but no checksum
  };
  Kind kind = Kind::accepted;
  std::optional<std::int64_t> number;  ///< of a numbered line
  std::string body;                    ///< an accepted line without number and checksum
};

class LineCheck {
 public:
  LineVerdict check(std::string_view line);

  std::int64_t last() const { return last_; }  ///< the number accepted last
  void set_last(std::int64_t number) { last_ = number; }

 private:
  LineVerdict::Kind judge(std::string_view line, std::int64_t number, bool resets) const;

  std::int64_t last_ = 0;
};

std::uint8_t checksum(std::string_view bytes);
/// The sentence that follows "Error:" for a refused line, with the number of the last good one.
std::string refusal(LineVerdict::Kind kind, std::int64_t last);

}  // namespace unicursal::sim
