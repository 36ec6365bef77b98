#include "firmware_gcode/interruption/pause.hpp"

#include <algorithm>
#include <cassert>

#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/interruption/aside.hpp"

namespace unicursal::gcode {
namespace {

constexpr double cooler_by =
    60;  ///< °C; plastic then neither drips nor chars, and heats up again within a minute

[[maybe_unused]] bool known(const ModalState& state) {
  return state.position[0] && state.position[1] && state.position[2] && !state.relative;
}

}  // namespace

Chunk go_aside(const Printer& printer, const Pause& pause) {
  assert(known(pause.state));
  AsideWriter writer(printer, pause.state, pause.state.drawn_back);
  const double z = *pause.state.position[2];
  writer.draw_back();
  writer.height(height_aside(printer, z, pause.state));
  writer.travel(place_beside(printer, pause.extent).value_or(core::Vec2(0, printer.bed[1])));
  if (pause.cool) writer.line("{}", cool_aside(pause.state));
  writer.line("M400");
  return writer.take();
}

std::string cool_aside(const ModalState& state) {
  return "M104 S" + short_number(std::max(0.0, state.nozzle - cooler_by), 1);
}

Chunk come_back(const Printer& printer, const Pause& pause) {
  assert(known(pause.state));
  AsideWriter writer(printer, pause.state, std::max(pause.state.drawn_back, printer.retraction_length));
  writer.choose_extruder();
  writer.heat();
  if (place_beside(printer, pause.extent)) {
    writer.squeeze(printer.dead_volume + printer.mixing_volume, pause.flow);
    writer.draw_back();
  }
  writer.approach();
  return writer.take();
}

}  // namespace unicursal::gcode
