// Names and texts from files, on their way to a terminal, which obeys control characters.
#pragma once

#include <string>
#include <string_view>

namespace unicursal::host {

/// UTF-8, line ends and tabs stay; other control characters, and bytes that are not UTF-8, become \xNN.
std::string for_terminal(std::string_view text);

}  // namespace unicursal::host
