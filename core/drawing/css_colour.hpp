// Colours in CSS notation: the 148 names, #rgb, #rrggbb (and #rgba, #rrggbbaa), rgb(), rgba().
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace unicursal::core {

/// Returns "#rrggbb" in lower case, "none" for a fully transparent colour, or nullopt if `text` is not a
/// colour. Case does not matter. Partly transparent colours count as opaque.
std::optional<std::string> css_colour(std::string_view text);

}  // namespace unicursal::core
