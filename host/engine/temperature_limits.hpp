// The highest temperatures that a user can ask for, °C, as for a profile; a higher one is a typing error.
#pragma once

namespace unicursal::host {

inline constexpr double hottest_nozzle = 450;
inline constexpr double hottest_bed = 200;

}  // namespace unicursal::host
