// The line that a person is typing, when the program reads single keys (host/cli/keyboard.hpp). It knows the
// keys that a terminal itself would obey: Enter, Backspace, Ctrl-U and Ctrl-W. Other control characters, and
// the sequences of arrows and function keys, have no effect.
//
//   for (const std::string& words : line.take(bytes)) answer(words);
//   show(line.text());
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace unicursal::host {

class TypedLine {
 public:
  /// Takes what was typed. Returns the lines that it completes. Text beyond `longest` bytes of a line is
  /// lost.
  std::vector<std::string> take(std::string_view bytes);
  /// The line so far. It may end in a part of a character.
  const std::string& text() const { return text_; }

  static constexpr std::size_t longest = 1000;

 private:
  enum class Sequence { none, begun, parameters, one_more };

  void obey(char key);
  bool skips(char byte);

  std::string text_;
  Sequence sequence_ = Sequence::none;  ///< of a key that is not a character
};

}  // namespace unicursal::host
