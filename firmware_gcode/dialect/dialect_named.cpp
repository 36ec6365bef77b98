#include "firmware_gcode/dialect/dialect_named.hpp"

#include "core/error.hpp"
#include "firmware_gcode/dialect/marlin.hpp"
#include "firmware_gcode/dialect/repetier.hpp"

namespace unicursal::gcode {

const Dialect& dialect_named(const std::string& firmware) {
  static const Marlin marlin;
  static const Repetier repetier;
  if (firmware == "marlin") return marlin;
  if (firmware == "repetier") return repetier;
  throw core::DataError("", "firmware", "the dialect \"" + firmware + "\" is not spoken yet",
                        "use firmware = \"marlin\" or \"repetier\" in the printer's profile");
}

}  // namespace unicursal::gcode
