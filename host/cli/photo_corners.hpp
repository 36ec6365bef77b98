// The value of --corners: where the corner marks of a test print are in a photo.
#pragma once

#include <optional>
#include <string>

#include "host/photo/sheet.hpp"

namespace unicursal::host {

/// "x,y,x,y,x,y,x,y" in pixels. Throws core::DataError.
std::optional<GivenCorners> corners_in(const std::optional<std::string>& text);

}  // namespace unicursal::host
