#include "firmware_gcode/dialect/dialect_named.hpp"

#include "core/error.hpp"
#include "firmware_gcode/dialect/marlin.hpp"
#include "firmware_gcode/dialect/repetier.hpp"
#include "firmware_gcode/dialect/reprapfirmware.hpp"

namespace unicursal::gcode {

const Dialect& dialect_named(const std::string& firmware) {
  static const Marlin marlin;
  static const Repetier repetier;
  static const RepRapFirmware reprapfirmware;
  if (firmware == "marlin") return marlin;
  if (firmware == "repetier") return repetier;
  if (firmware == "reprapfirmware") return reprapfirmware;
  throw core::DataError(
      "", "firmware", "the dialect \"" + firmware + "\" is not supported yet",
      "use firmware = \"marlin\", \"repetier\" or \"reprapfirmware\" in the printer's profile");
}

}  // namespace unicursal::gcode
