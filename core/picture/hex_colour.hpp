// Colours as people write them: "#e0604a".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/picture/image.hpp"

namespace unicursal::picture {

/// Absent unless the text is a # with six hexadecimal digits.
std::optional<Colour> colour_in(std::string_view text);

/// "#e0604a"
std::string hex_of(Colour colour);

}  // namespace unicursal::picture
