// One line of G-code taken apart: a letter and a number, and the words behind them.
//
// Sources: the NIST RS274/NGC interpreter, section 3 (words, comments in parentheses); Marlin 2.1
// (its GCodeParser: a subcode behind a point; N and the checksum).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace unicursal::gcode {

struct SlicedCommand {
  char letter = 0;  ///< 'G', 'M' or 'T'; 0: not a command
  int code = -1;
  int sub = 0;            ///< 1 for G92.1
  std::string_view text;  ///< all of it, without line number, checksum and comment
  std::string_view name;  ///< its first word

  bool is(char which, int number) const { return letter == which && code == number; }
  /// Whether the word is there, with a number or without.
  bool has(char word) const { return (there_ & bit(word)) != 0; }
  /// Whether it is there with a number.
  bool valued(char word) const { return (valued_ & bit(word)) != 0; }
  /// Precondition: valued(word).
  double value(char word) const { return values_[static_cast<std::size_t>(word - 'A')]; }
  double value_or(char word, double otherwise) const { return valued(word) ? value(word) : otherwise; }
  /// Whether a number could not be read, or a word is there twice.
  bool damaged = false;

 private:
  friend SlicedCommand parse_command(std::string_view line);
  static std::uint32_t bit(char word) { return std::uint32_t{1} << (word - 'A'); }

  std::uint32_t there_ = 0, valued_ = 0;
  std::array<double, 26> values_{};
};

/// `line` has no comment behind ';'. The result refers to its bytes.
SlicedCommand parse_command(std::string_view line);

/// The line up to its comment, without spaces at its ends, and the comment without its ';'.
struct SplitLine {
  std::string_view command, comment;
  bool has_comment = false;
};
SplitLine split_comment(std::string_view line);

std::string_view trimmed(std::string_view text);

}  // namespace unicursal::gcode
