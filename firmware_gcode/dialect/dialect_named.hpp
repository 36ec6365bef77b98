// The dialects that are spoken, by the name that a printer's profile gives.
#pragma once

#include <string>

#include "firmware_gcode/dialect/dialect.hpp"

namespace unicursal::gcode {

/// The dialect of a profile's `firmware` key, "marlin" or "repetier". Throws core::DataError for any other.
const Dialect& dialect_named(const std::string& firmware);

}  // namespace unicursal::gcode
