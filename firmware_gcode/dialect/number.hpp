// Numbers for G-code: fixed point, as short as their precision allows.
#pragma once

#include <cstdint>
#include <string>

namespace unicursal::gcode {

/// Returns a value in units of its last written decimal: scaled(1.25, 3) is 1250. Rounds half away from zero.
/// Precondition: finite, and the result fits (|value| < 1e12 for up to 6 decimals).
std::int64_t scaled(double value, int decimals);

/// Appends a scaled value without trailing zeros, a leading zero or a negative zero: 1250 with 3
/// decimals is "1.25", -500 is "-.5", 0 is "0".
void append_scaled(std::string& text, std::int64_t value, int decimals);

/// The text of a value: short_number(0.25, 4) is ".25".
std::string short_number(double value, int decimals);

}  // namespace unicursal::gcode
