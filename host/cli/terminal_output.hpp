// Text on standard output and standard error. A stream that is full or closed does not end a print: text that
// cannot be written is dropped. Names and texts from files, printers and daemons cannot command the terminal:
// what show() writes has no control characters but line ends and tabs (host/cli/for_terminal.hpp).
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "host/cli/for_terminal.hpp"

namespace unicursal::host {

template <class... Arguments>
void show(std::FILE* stream, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  std::fputs(for_terminal(fmt::format(text, std::forward<Arguments>(arguments)...)).c_str(), stream);
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
