// Words for people: foreign text made safe to show, and a bounded list of warnings.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace unicursal::core {

/// Text from a file in quotes: at most 40 bytes of it, control characters shown as '?'.
std::string in_quotes(std::string_view text);

/// "a, b and 3 more": at most `limit` items; "nothing" for none.
std::string listed(const std::vector<std::string>& items, std::size_t limit = 12);

/// `text` with the letters A to Z in lower case; other bytes stay, and so does their number.
std::string lower(std::string_view text);

/// Keeps each sentence once and at most 20 of them, so that a hostile file cannot flood the terminal.
class Warnings {
 public:
  void add(std::string sentence);
  /// The sentences in the order they came; a last one counts those left out.
  std::vector<std::string> sentences() const;

 private:
  std::vector<std::string> sentences_;
  std::size_t left_out_ = 0;
};

}  // namespace unicursal::core
