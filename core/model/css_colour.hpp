// Colours as CSS writes them: the 148 names, #rgb, #rrggbb (and #rgba, #rrggbbaa), rgb(), rgba().
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace unicursal::core {

/// "#rrggbb" in lower case, or "none" for a colour that is wholly transparent; nothing where `text` is no
/// colour. Case does not matter. Partly transparent colours count as if they were not.
std::optional<std::string> css_colour(std::string_view text);

}  // namespace unicursal::core
