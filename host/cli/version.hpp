// The version as CMake knows it.
#pragma once

namespace unicursal::host {

inline constexpr const char* version = UNICURSAL_VERSION;

}  // namespace unicursal::host
