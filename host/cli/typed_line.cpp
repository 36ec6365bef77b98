#include "host/cli/typed_line.hpp"

#include <utility>

namespace unicursal::host {
namespace {

constexpr char escape = 0x1b, erase = 0x7f, backspace = 0x08, kill_line = 0x15, kill_word = 0x17;

void drop_character(std::string& text) {
  while (!text.empty()) {
    const bool continues = (static_cast<unsigned char>(text.back()) & 0xc0U) == 0x80U;
    text.pop_back();
    if (!continues) return;
  }
}

void drop_word(std::string& text) {
  while (!text.empty() && text.back() == ' ') text.pop_back();
  while (!text.empty() && text.back() != ' ') text.pop_back();
}

}  // namespace

std::vector<std::string> TypedLine::take(std::string_view bytes) {
  std::vector<std::string> lines;
  for (const char byte : bytes) {
    if (skips(byte)) continue;
    if (byte == '\n' || byte == '\r')
      lines.push_back(std::exchange(text_, {}));
    else
      obey(byte);
  }
  return lines;
}

void TypedLine::obey(char key) {
  if (key == erase || key == backspace) return drop_character(text_);
  if (key == kill_line) return text_.clear();
  if (key == kill_word) return drop_word(text_);
  const bool control = static_cast<unsigned char>(key) < ' ';
  if (!control && text_.size() < longest) text_ += key;
}

/// ECMA-48: ESC [, parameters, and a letter; ESC O and a letter; or ESC and a letter.
bool TypedLine::skips(char byte) {
  switch (sequence_) {
    case Sequence::none:
      if (byte != escape) return false;
      sequence_ = Sequence::begun;
      return true;
    case Sequence::begun:
      sequence_ = byte == '[' ? Sequence::parameters : byte == 'O' ? Sequence::one_more : Sequence::none;
      return true;
    case Sequence::parameters:
      if (byte >= '@' && byte <= '~') sequence_ = Sequence::none;
      return true;
    case Sequence::one_more:
      sequence_ = Sequence::none;
  }
  return true;
}

}  // namespace unicursal::host
