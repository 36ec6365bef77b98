// UTF-8 as RFC 3629 defines it.
#pragma once

#include <cstddef>
#include <string_view>

namespace unicursal::core {

/// Bytes of the character that `text` begins with; 0 if it does not begin with one, or is empty.
std::size_t utf8_size(std::string_view text);
bool is_utf8(std::string_view text);

}  // namespace unicursal::core
