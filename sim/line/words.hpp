// Parses a command line into its words: `G1 X10 Y-2.5` is G 1 with X = 10 and Y = −2.5. The parser shares
// nothing with the code that writes the lines, on purpose (sim/README.md).
// Grammar: G, M or T and a number; then upper-case letters, each with or without a decimal number, spaces
// optional. There are no exponents (E is a word). A lower-case command is unknown, as in Marlin by default.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace unicursal::sim {

class Command {
 public:
  Command(char letter, int code) : letter_(letter), code_(code) {}

  char letter() const { return letter_; }
  int code() const { return code_; }
  bool is(char letter, int code) const { return letter_ == letter && code_ == code; }

  /// Whether the line has this word, with or without a number.
  bool has(char letter) const { return (seen_ & bit(letter)) != 0; }
  std::optional<double> value(char letter) const;
  double value_or(char letter, double otherwise) const { return value(letter).value_or(otherwise); }

  void set(char letter, std::optional<double> value);

 private:
  static std::size_t place(char letter) { return static_cast<std::size_t>(letter - 'A'); }
  static std::uint32_t bit(char letter) { return std::uint32_t{1} << place(letter); }

  char letter_;
  int code_;
  std::uint32_t seen_ = 0, valued_ = 0;
  std::array<double, 26> values_{};
};

/// Numbers are clamped to ± this, so that no text can overflow the arithmetic of steps.
inline constexpr double largest_number = 1e9;

/// Returns nullopt if the text does not start with G, M or T and a number.
std::optional<Command> parse_command(std::string_view text);

}  // namespace unicursal::sim
