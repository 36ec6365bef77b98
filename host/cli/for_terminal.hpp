// Names and texts from files, on their way to a terminal, which obeys control characters.
#pragma once

#include <string>
#include <string_view>

namespace unicursal::host {

/// UTF-8, line ends and tabs stay; other control characters, and bytes that are not UTF-8, become \xNN.
std::string for_terminal(std::string_view text);

/// The same for the text of JSON, in which only DEL and U+0080 to U+009F can stand unescaped; they become
/// \u00NN.
std::string json_for_terminal(std::string_view json);

}  // namespace unicursal::host
