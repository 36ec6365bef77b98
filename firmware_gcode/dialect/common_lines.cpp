#include "firmware_gcode/dialect/common_lines.hpp"

#include <fmt/format.h>

#include "firmware_gcode/dialect/number.hpp"

namespace unicursal::gcode {
namespace {

/// s without a command; when the host dies, only the firmware can cool the heaters.
constexpr int inactivity_shutdown = 1800;

}  // namespace

std::string comment(const std::string& text) {
  std::string line = ";" + text;
  for (char& c : line) {
    if (c < ' ' || c > '~') c = '?';
  }
  return line;
}

std::vector<std::string> modes() {
  return {"G21", "G90", "M83", "G92 E0"};
}

std::vector<std::string> calibration(const Printer& printer) {
  if (!printer.extruder_steps) return {};
  return {"M92 E" + short_number(*printer.extruder_steps, 3)};
}

std::string shut_down_after(int seconds) {
  return fmt::format("M85 S{}", seconds);
}

std::string stay_watchful() {
  return shut_down_after(inactivity_shutdown);
}

}  // namespace unicursal::gcode
