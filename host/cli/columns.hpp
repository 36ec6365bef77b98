// How wide a text is on a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace unicursal::host {

/// Columns of the text, which is UTF-8 without control characters: characters of East Asia and pictures take
/// two (Unicode's EastAsianWidth.txt, in whole blocks), combining marks none.
std::size_t columns(std::string_view text);

/// The longest beginning of the text that fits.
std::string beginning(std::string_view text, std::size_t width);
/// The longest end of the text that fits.
std::string ending(std::string_view text, std::size_t width);

}  // namespace unicursal::host
