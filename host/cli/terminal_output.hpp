// Text on standard output and standard error. A stream that is full or closed does not end a print: text that
// cannot be written is dropped. Names and texts from files, printers and daemons cannot command the terminal:
// what show() writes has no control characters but line ends and tabs (host/cli/for_terminal.hpp). On a
// terminal, lines that are wider than its window are broken between words (host/cli/wrapped.hpp).
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "host/cli/for_terminal.hpp"

namespace unicursal::host {

void show_text(std::FILE* stream, const std::string& text);

template <class... Arguments>
void show(std::FILE* stream, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  show_text(stream, fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// Shows the program's own text with the lines that it has: scripts, and pictures made of characters.
inline void show_as_it_is(std::FILE* stream, const std::string& text) {
  std::fputs(text.c_str(), stream);
}

/// Shows JSON, as dump() makes it, in a line of its own. It stays valid JSON.
inline void show_json_text(std::FILE* stream, const std::string& json) {
  std::fputs((json_for_terminal(json) + "\n").c_str(), stream);
}

/// Clears the line in which the cursor stands.
inline void erase_line(std::FILE* stream) {
  std::fputs("\r\x1b[K", stream);
}

}  // namespace unicursal::host
