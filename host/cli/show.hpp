// Words for a terminal, a file or a pipe that may be full or gone: what cannot be shown ends no print.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace unicursal::host {

template <class... Arguments>
void show(std::FILE* where, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  std::fputs(fmt::format(text, std::forward<Arguments>(arguments)...).c_str(), where);
}

}  // namespace unicursal::host
