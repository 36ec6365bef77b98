// Foreign text made safe to show and to log.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace unicursal::core {

/// Returns `text` with every byte outside printable ASCII written as \xNN. After `limit` bytes of input the
/// text is cut and ends with an ellipsis.
std::string printable(std::string_view text, std::size_t limit = 200);

}  // namespace unicursal::core
