// Reads the numbers and letters of SVG attributes (path data, transforms, point lists, lengths). Numbers
// follow the SVG grammar: no inf or nan, "1.5.5" is 1.5 and .5, "1-2" is 1 and -2.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace unicursal::core {

class NumberScanner {
 public:
  explicit NumberScanner(std::string_view text) : text_(text) {}

  void skip_spaces();
  /// Skips spaces and at most one comma.
  void skip_separator();
  bool at_end() const { return at_ >= text_.size(); }
  std::size_t position() const { return at_; }
  /// The next character; '\0' at the end.
  char peek() const { return at_end() ? '\0' : text_[at_]; }
  void advance() { ++at_; }
  bool starts_number() const;

  /// Reads a number. Returns nullopt without moving if no number starts here. Throws Malformed if the number
  /// is out of range.
  std::optional<double> number();
  /// Reads a number after an optional separator; throws Malformed if there is none.
  double required();
  /// Reads a single 0 or 1 after an optional separator (the flag of an arc); throws Malformed otherwise.
  bool flag();
  /// Reads all letters from here on; may be empty.
  std::string_view word();
  std::string_view rest() const { return text_.substr(at_); }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// All numbers of a list separated by spaces or commas. Throws Malformed if it contains anything else.
std::vector<double> numbers(std::string_view text);

}  // namespace unicursal::core
