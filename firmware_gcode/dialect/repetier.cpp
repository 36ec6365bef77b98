#include "firmware_gcode/dialect/repetier.hpp"

#include <fmt/format.h>

#include <cmath>

namespace unicursal::gcode {
namespace {

constexpr double parts = 100;  ///< in which a share is written

Limits own_limits() {
  Limits limits;
  limits.feeders = 6;
  limits.extrusion = 160;
  limits.mixture_decimals = 2;
  limits.tool_change_stops = true;
  limits.shares_act_at_once = true;
  return limits;
}

}  // namespace

const Limits& Repetier::limits() const {
  static const Limits limits = own_limits();
  return limits;
}

std::vector<std::string> Repetier::define_tool(std::size_t tool, const Mixture& mixture) const {
  std::vector<std::string> lines = {"M400"};
  for (std::size_t feeder = 0; feeder < mixture.feeders(); ++feeder) {
    lines.push_back(fmt::format("M163 S{} P{}", feeder, std::lround(mixture.share(feeder) * parts)));
  }
  lines.push_back(fmt::format("M164 S{}", tool));
  return lines;
}

std::string Repetier::select_tool(std::size_t tool) const {
  return fmt::format("T{}", tool);
}

}  // namespace unicursal::gcode
