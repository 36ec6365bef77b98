// Breaks lines where words end, so that a narrow window does not break them within a word.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace unicursal::host {

/// Breaks each line of the text that is wider than `width` columns at blanks. What follows has the blanks
/// with which the line begins. A word that is wider than a line keeps a line of its own, and so does what
/// stands in a pair of backticks, which is a command to be copied.
std::string wrapped(std::string_view text, std::size_t width);

}  // namespace unicursal::host
