#include "host/cli/for_terminal.hpp"

#include <fmt/format.h>

#include "core/text/utf8.hpp"

namespace unicursal::host {
namespace {

/// U+0000 to U+001F, and U+007F to U+009F; line ends and tabs are not among them.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return (first < ' ' && first != '\n' && first != '\t') || first == 0x7f;
  return character.size() == 2 && first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

/// `escaped` writes a character, or a byte that is none, that may not be shown.
template <typename Escaped>
std::string shown(std::string_view text, Escaped escaped) {
  std::string safe;
  while (!text.empty()) {
    const std::size_t size = core::utf8_size(text);
    const std::string_view character = text.substr(0, size == 0 ? 1 : size);
    if (size != 0 && !is_control(character)) {
      safe += character;
    } else {
      safe += escaped(character);
    }
    text.remove_prefix(character.size());
  }
  return safe;
}

}  // namespace

std::string for_terminal(std::string_view text) {
  return shown(text, [](std::string_view character) {
    std::string bytes;
    for (const char byte : character) bytes += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    return bytes;
  });
}

std::string json_for_terminal(std::string_view json) {
  return shown(json, [](std::string_view character) {
    return fmt::format("\\u{:04x}", static_cast<unsigned char>(character.back()));
  });
}

}  // namespace unicursal::host
