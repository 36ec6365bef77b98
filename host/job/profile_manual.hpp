// The manual page unicursal-profile(5), in mdoc(7).
#pragma once

#include <string_view>

namespace unicursal::host {

std::string_view profile_manual();

}  // namespace unicursal::host
