#include "firmware_gcode/dialect/reprapfirmware.hpp"

#include "firmware_gcode/dialect/number.hpp"

namespace unicursal::gcode {
const Limits& RepRapFirmware::limits() const {
  static const Limits limits;
  return limits;
}

std::string RepRapFirmware::write_shares(const Mixture& mixture) const {
  const Mixture written = as_written(mixture);
  std::string line = "M567 P0 E";
  for (const double share : written.shares())
    line += (line.back() == 'E' ? "" : ":") + short_number(share, limits().mixture_decimals);
  return line;
}

}  // namespace unicursal::gcode
