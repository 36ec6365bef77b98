// Text on standard output and standard error. A stream that is full or closed does not end a print: text that
// cannot be written is dropped.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace unicursal::host {

template <class... Arguments>
void show(std::FILE* stream, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  std::fputs(fmt::format(text, std::forward<Arguments>(arguments)...).c_str(), stream);
}

}  // namespace unicursal::host
