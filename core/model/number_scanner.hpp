// Reads the numbers and letters of SVG attributes (path data, transforms, point lists, lengths).
// Numbers follow the SVG grammar: no inf or nan, "1.5.5" is 1.5 and .5, "1-2" is 1 and -2.
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
  /// Spaces and at most one comma.
  void skip_separator();
  bool at_end() const { return at_ >= text_.size(); }
  std::size_t position() const { return at_; }
  /// '\0' at the end.
  char peek() const { return at_end() ? '\0' : text_[at_]; }
  void advance() { ++at_; }
  bool starts_number() const;

  /// Nothing, and no step forward, where no number starts. Throws Malformed for numbers beyond double's
  /// range.
  std::optional<double> number();
  /// A number after an optional separator; throws Malformed where none is.
  double required();
  /// A single 0 or 1 after an optional separator (the flags of an arc); throws Malformed otherwise.
  bool flag();
  /// Letters, as many as follow each other.
  std::string_view word();
  std::string_view rest() const { return text_.substr(at_); }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// Every number of a list separated by spaces or commas; throws Malformed if anything else is there.
std::vector<double> numbers(std::string_view text);

}  // namespace unicursal::core
