#include "firmware_gcode/dialect/dialect.hpp"

#include "core/error.hpp"
#include "firmware_gcode/dialect/marlin.hpp"

namespace unicursal::gcode {

const Dialect& dialect_named(const std::string& firmware) {
  static const Marlin marlin;
  if (firmware == "marlin") return marlin;
  throw core::DataError("", "firmware", "the dialect \"" + firmware + "\" is not spoken yet",
                        "use firmware = \"marlin\" in the printer's profile");
}

}  // namespace unicursal::gcode
