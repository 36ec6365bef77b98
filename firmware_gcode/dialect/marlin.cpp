#include "firmware_gcode/dialect/marlin.hpp"

#include <fmt/format.h>

#include "firmware_gcode/dialect/number.hpp"

namespace unicursal::gcode {

const Limits& Marlin::limits() const {
  static const Limits limits;
  return limits;
}

std::vector<std::string> Marlin::define_tool(std::size_t tool, const Mixture& mixture) const {
  std::vector<std::string> lines;
  for (std::size_t feeder = 0; feeder < mixture.feeders(); ++feeder) {
    lines.push_back(
        fmt::format("M163 S{} P{}", feeder, short_number(mixture.share(feeder), limits().mixture_decimals)));
  }
  lines.push_back(fmt::format("M164 S{}", tool));
  return lines;
}

std::string Marlin::select_tool(std::size_t tool) const {
  return fmt::format("T{}", tool);
}

}  // namespace unicursal::gcode
