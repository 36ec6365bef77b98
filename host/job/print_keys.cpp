#include "host/job/print_keys.hpp"

#include <fmt/format.h>

#include <cmath>

#include "firmware_gcode/print/bounds.hpp"

namespace unicursal::host {
namespace {

constexpr double most_loops = 20;           ///< of a skirt
constexpr double farthest_skirt = 100;      ///< mm
constexpr double least_first_speed = 0.05;  ///< fraction of the others'; less is a typing error
constexpr double most_layers = 1e6;
constexpr double least_printing = 150, most_printing = 450;  ///< °C of a nozzle that prints

Range layers() {
  return between(0, most_layers, "");
}

std::size_t whole(const Section& section, std::string_view key, double value) {
  if (value != std::floor(value)) section.fail(key, "is not a whole number", "write for example 1");
  return static_cast<std::size_t>(value);
}

void read_speed(const Section& part, Job& job) {
  const Range range = between(gcode::bounds::speed.least, gcode::bounds::speed.greatest, "mm/s");
  if (part.has("speed")) {
    if (part.has("flow")) {
      part.fail("speed", "cannot be held beside a flow", "leave out either part.speed or part.flow");
    }
    job.print.speed = part.number("speed", range, "write for example speed = 20");
  }
  job.print.first_layer_speed =
      part.number_or("first_layer_speed", 1, between(least_first_speed, 1, ""),
                     "write the part of the other layers' speed, for example first_layer_speed = 0.5");
}

void read_skirt(const Section& part, gcode::Skirt& skirt) {
  const char* const remedy = "write how many rings, for example skirt = 2, or { loops = 2, distance = 5 }";
  const toml::node* node = part.find("skirt");
  if (!node) return;
  const Range loops = between(0, most_loops, "");
  if (!node->is_table()) {
    skirt.loops = static_cast<int>(whole(part, "skirt", part.number("skirt", loops, remedy)));
    return;
  }
  const Section table = part.section("skirt", {"loops", "distance"}, remedy);
  skirt.loops = static_cast<int>(whole(table, "loops", table.number("loops", loops, remedy)));
  skirt.distance = table.number_or("distance", skirt.distance, between(0, farthest_skirt, "mm"), remedy);
}

void read_fan(const Section& part, gcode::Fan& fan) {
  const char* const remedy = "write per cent, for example fan = 50, or { percent = 50, from = 2 }";
  const toml::node* node = part.find("fan");
  if (!node) return;
  const Range percent = between(0, 100, "%");
  if (!node->is_table()) {
    fan.percent = part.number("fan", percent, remedy);
    return;
  }
  const Section table = part.section("fan", {"percent", "from"}, remedy);
  fan.percent = table.number("percent", percent, remedy);
  fan.from = whole(table, "from", table.number_or("from", 0, layers(), remedy));
}

gcode::LayerTemperature read_temperature(const Section& entry) {
  const char* const remedy = "write for example { layer = 1, nozzle = 205 }";
  gcode::LayerTemperature change;
  change.layer = whole(entry, "layer", entry.number("layer", layers(), remedy));
  if (entry.has("nozzle")) {
    change.nozzle = entry.number("nozzle", between(least_printing, most_printing, "°C"), remedy);
  }
  if (entry.has("bed")) {
    const gcode::Bounds& bed = gcode::bounds::bed_temperature;
    change.bed = entry.number("bed", between(bed.least, bed.greatest, "°C"), remedy);
  }
  if (!change.nozzle && !change.bed) entry.fail("layer", "changes neither nozzle nor bed", remedy);
  return change;
}

void read_temperatures(const Section& part, Job& job) {
  const char* const remedy =
      "write a list such as [{ layer = 0, nozzle = 215 }, { layer = 1, nozzle = 205 }]";
  const toml::node* node = part.find("temperatures");
  if (!node) return;
  const toml::array* list = node->as_array();
  if (!list) part.fail("temperatures", "is not a list", remedy);
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::table* table = (*list)[i].as_table();
    if (!table) part.fail("temperatures", "holds something that is not a table", remedy);
    const Section entry(part.file(), *table, fmt::format("part.temperatures[{}]", i),
                        {"layer", "nozzle", "bed"});
    job.print.temperatures.push_back(read_temperature(entry));
    if (i > 0 && job.print.temperatures[i].layer <= job.print.temperatures[i - 1].layer) {
      entry.fail("layer", "does not come after the one before it", "sort the list by layer, each layer once");
    }
  }
}

}  // namespace

void read_print_keys(const Section& part, Job& job) {
  read_speed(part, job);
  read_skirt(part, job.print.skirt);
  read_fan(part, job.print.fan);
  read_temperatures(part, job);
}

}  // namespace unicursal::host
