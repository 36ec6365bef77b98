// The supported dialects, by their names in a printer's profile.
#pragma once

#include <string>

#include "firmware_gcode/dialect/dialect.hpp"

namespace unicursal::gcode {

/// The dialect of a profile's `firmware` key, "marlin" or "repetier". Throws core::DataError for any other.
const Dialect& dialect_named(const std::string& firmware);

}  // namespace unicursal::gcode
