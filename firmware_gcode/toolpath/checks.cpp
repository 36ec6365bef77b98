#include "firmware_gcode/toolpath/checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <string_view>

#include "core/error.hpp"
#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/mixing/chamber.hpp"
#include "firmware_gcode/print/bounds.hpp"

namespace unicursal::gcode {
namespace {

constexpr double outside_tolerance = 5e-4;   ///< mm; half the resolution of a written position
constexpr std::size_t longest_command = 80;  ///< characters; leaves room for line number and checksum

void require(bool good, const std::string& place, const std::string& problem, const std::string& remedy) {
  if (!good) throw core::DataError("", place, problem, remedy);
}

/// Returns false for NaN.
bool within(double value, double low, double high) {
  return value >= low && value <= high;
}

void require_within(double value, const Bounds& bounds, const std::string& key, const std::string& unit) {
  require(bounds.hold(value), key,
          fmt::format("{:g} is not between {:g} and {:g} {}", value, bounds.least, bounds.greatest, unit),
          "correct it in the printer's profile");
}

void require_positive(double value, const std::string& key) {
  require(std::isfinite(value) && value > 0, key, "is not a number above zero", "give a positive number");
}

std::string where(const PlacedLayer& layer, const core::Vec2& point) {
  return fmt::format("layer {} at x {:.3f}, y {:.3f} mm", layer.index, point.x(), point.y());
}

void check_bead(const core::Bead& bead, const PlacedLayer& layer, const PrintSettings& settings,
                const Printer& printer) {
  const core::Vec2& p = bead.position;
  require(p.allFinite() && within(bead.area, 0, printer.bed[0] * printer.bed[1]), where(layer, p),
          "a position is not finite, or an area is negative or larger than the bed",
          "this is a defect of the curve; please report it");
  require(within(p.x(), -outside_tolerance, printer.bed[0] + outside_tolerance) &&
              within(p.y(), -outside_tolerance, printer.bed[1] + outside_tolerance),
          where(layer, p),
          fmt::format("the nozzle would leave the bed of {:g} x {:g} mm", printer.bed[0], printer.bed[1]),
          "place the part inside the bed or make it smaller");
  require(bead.zone < settings.zone_materials.size(), where(layer, p),
          fmt::format("zone {} has no mixture", bead.zone), "give every zone a mixture");
}

std::string stripped(std::string line) {
  line = line.substr(0, line.find(';'));
  const auto first = line.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

bool printable(std::string_view text) {
  for (char c : text) {
    if (c < ' ' || c > '~') return false;
  }
  return true;
}

bool breaks_numbering(const std::string& line) {
  return line.find('*') != std::string::npos || line.front() == 'N' || line.front() == 'n' ||
         line.starts_with("M110");
}

void check_motion(const Motion& motion) {
  for (double jerk : motion.jerk) require_within(jerk, bounds::jerk, "jerk", "mm/s");
  require_within(motion.extruder_jerk, bounds::jerk, "extruder jerk", "mm/s");
  require_within(motion.junction_deviation, bounds::junction_deviation, "junction_deviation", "mm");
  require_within(motion.extruder_speed, bounds::speed, "extruder speed", "mm/s");
  for (double a : {motion.acceleration, motion.travel_acceleration, motion.retract_acceleration,
                   motion.extruder_acceleration}) {
    require_within(a, bounds::acceleration, "acceleration", "mm/s²");
  }
}

}  // namespace

void check_printer(const Printer& printer) {
  for (double side : printer.bed) require_within(side, bounds::bed, "bed", "mm");
  for (double speed : printer.max_speed) require_within(speed, bounds::speed, "max_speed", "mm/s");
  for (double acceleration : printer.max_acceleration) {
    require_within(acceleration, bounds::acceleration, "max_acceleration", "mm/s²");
  }
  for (double width : printer.bead_width_range) {
    require_within(width, bounds::bead_width, "bead_width_range", "mm");
  }
  require_within(printer.nozzle, bounds::nozzle, "nozzle", "mm");
  require_within(printer.filament_diameter, bounds::filament_diameter, "filament_diameter", "mm");
  require_within(printer.max_flow, bounds::flow, "max_flow", "mm³/s");
  require_within(printer.retraction_length, bounds::retraction_length, "retraction_length", "mm");
  require_within(printer.retraction_speed, bounds::speed, "retraction_speed", "mm/s");
  require_within(printer.z_hop, bounds::z_hop, "z_hop", "mm");
  for (double factor : printer.flow_factors) require_within(factor, bounds::flow_factor, "flow_factors", "");
  check_motion(printer.motion);
  require_within(printer.nozzle_temperature, bounds::nozzle_temperature, "nozzle temperature", "°C");
  require_within(printer.bed_temperature, bounds::bed_temperature, "bed temperature", "°C");
  require_within(printer.dead_volume, bounds::transition, "dead_volume", "mm³");
  require_within(printer.mixing_volume, bounds::transition, "mixing_volume", "mm³");
  require(printer.tanks >= 1 && printer.tanks <= max_tanks, "tanks",
          fmt::format("{} is not between 1 and {}", printer.tanks, max_tanks), "write for example tanks = 2");
  const std::size_t most = dialect_named(printer.firmware).limits().feeders;
  require(printer.feeders >= least_feeders && printer.feeders <= most, "feeders",
          fmt::format("{} feeders cannot be mixed by {}", printer.feeders, printer.firmware),
          fmt::format("use a printer with {} to {}", least_feeders, most));
  require(printer.flow_factors.size() == printer.feeders, "flow_factors",
          fmt::format("has {} numbers for {} feeders", printer.flow_factors.size(), printer.feeders),
          "give one number for each feeder");
  const double equal = 1 / static_cast<double>(printer.feeders);
  require(within(printer.floor_share, 0, equal), "floor_share",
          fmt::format("is not between 0 and {:.3g}, an equal share of {} feeders", equal, printer.feeders),
          "give a small share such as 0.02");
}

void check_settings(const PrintSettings& settings, const Printer& printer) {
  require(!settings.materials.empty(), "mixture", "there is none", "define at least one mixture");
  for (std::size_t material : settings.zone_materials) {
    require(material < settings.materials.size(), "zone", "a zone's mixture does not exist",
            "name a mixture that the job defines");
  }
  require(within(settings.change_before_border, 0.05, 0.95), "change_before_border",
          "is not between 0.05 and 0.95",
          "give the share of a change that may fall before its border, say 0.5");
  require_positive(settings.flow, "flow");
  require(!settings.speed || bounds::speed.hold(*settings.speed), "speed",
          "is outside the speeds that a printer can run", "give it in mm/s, say 20");
  require(settings.first_layer_speed > 0 && settings.first_layer_speed <= 1, "first_layer_speed",
          "is not between 0 and 1", "give a fraction of the other layers' speed, say 0.5");
  require(within(settings.fan.percent, 0, 100), "fan", "is not between 0 and 100 %", "correct it");
  for (const LayerTemperature& change : settings.temperatures) {
    if (change.nozzle) require_within(*change.nozzle, bounds::nozzle_temperature, "temperatures", "°C");
    if (change.bed) require_within(*change.bed, bounds::bed_temperature, "temperatures", "°C");
  }
  require(settings.flow <= printer.max_flow, "flow",
          fmt::format("{:g} mm³/s is more than the printer's max_flow of {:g} mm³/s", settings.flow,
                      printer.max_flow),
          "lower the job's flow");
}

void check_layer(const PlacedLayer& layer, const PrintSettings& settings, const Printer& printer) {
  const std::string place = fmt::format("layer {}", layer.index);
  require(layer.height > 0 && layer.height <= bounds::nozzle.greatest, place,
          fmt::format("its height is not between 0 and {:g} mm", bounds::nozzle.greatest),
          "give the layer height in millimetres");
  require(layer.top > 0 && layer.top <= printer.bed[2] + outside_tolerance, place,
          fmt::format("its top at {:g} mm is not within the printer's height of {:g} mm", layer.top,
                      printer.bed[2]),
          "make the part lower");
  for (const core::BeadPath& path : layer.paths) {
    for (const core::Bead& bead : path.beads) check_bead(bead, layer, settings, printer);
  }
}

void check_on_bed(const PlacedLayer& layer) {
  require(layer.index == 0 || rests_on_bed(layer), fmt::format("layer {}", layer.index),
          fmt::format("nothing is printed below it, so that it would begin in the air at {:g} mm",
                      layer.top - layer.height),
          "turn or place the part so that it stands on the bed");
}

std::vector<std::string> user_commands(const std::string& text, const std::string& key) {
  std::vector<std::string> commands;
  std::istringstream stream(text);
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    line = stripped(line);
    if (line.empty()) continue;
    const std::string place = fmt::format("{}, line {}", key, number);
    require(printable(line), place, "a character is not plain ASCII", "write G-code with ASCII letters only");
    require(line.size() <= longest_command, place,
            fmt::format("the command is longer than {} characters", longest_command), "shorten it");
    require(!breaks_numbering(line), place, "the program itself adds line numbers and checksums",
            "remove the N, the * or the M110");
    commands.push_back(line);
  }
  return commands;
}

}  // namespace unicursal::gcode
