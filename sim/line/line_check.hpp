// Checks the line number and checksum of a received line in Marlin 2.1's order: number first, then checksum.
// The checksum is the exclusive or of all bytes before the last `*`. Repetier compares numbers modulo 65536,
// treats the last forty as repeated, and takes a number without a checksum. RepRapFirmware compares no
// numbers: a numbered line may have a checksum, and everything behind it is dropped.
//
// This code shares nothing with the framing in host/link/ledger.hpp, on purpose: a mistake on one side must
// not hide in the other. (firmware_gcode/review/line_check.hpp checks what lines do, not how they are
// framed.)
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace unicursal::sim {

struct LineVerdict {
  enum class Kind {
    accepted,
    repeated,      ///< One of the last numbers again: not to be executed.
    wrong_number,  ///< Not the last number + 1.
    wrong_checksum,
    no_checksum,  ///< A number without a checksum.
  };
  Kind kind = Kind::accepted;
  std::optional<std::int64_t> number;  ///< nullopt if the line has none.
  std::string body;                    ///< An accepted line without number and checksum; otherwise empty.
};

/// An error that a fault makes the firmware commit with a sound line.
enum class Misreading {
  none,
  damaged,
  misnumbered,
  unchecked,
  forgotten,  ///< It accepts the line, and then asks for it again.
};

class LineCheck {
 public:
  enum class Rules { marlin, repetier, reprapfirmware };

  explicit LineCheck(Rules rules = Rules::marlin) : rules_(rules) {}

  LineVerdict check(std::string_view line);

  std::int64_t last() const { return last_; }  ///< The last accepted number.
  void set_last(std::int64_t number) { last_ = number; }

 private:
  LineVerdict check_checksum_only(std::string_view line);
  LineVerdict::Kind judge(std::string_view line, std::int64_t number, bool resets) const;
  bool follows(std::int64_t number) const;
  bool repeats(std::int64_t number) const;

  Rules rules_;
  std::int64_t last_ = 0;
};

std::uint8_t checksum(std::string_view bytes);
/// The text after "Error:" for a refused line; `last` is the number of the last good line.
std::string refusal(LineVerdict::Kind kind, std::int64_t last);

}  // namespace unicursal::sim
