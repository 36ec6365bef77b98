#include "firmware_gcode/interruption/lead_in.hpp"

#include <cassert>

#include "firmware_gcode/dialect/common_lines.hpp"
#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/interruption/aside.hpp"

namespace unicursal::gcode {
namespace {

constexpr double transitions =
    2;  ///< of plastic that is squeezed out, like the prime line at the start of a print

void heat(AsideWriter& writer, const ModalState& state) {
  writer.choose_extruder();
  writer.lines({stay_watchful(), "M220 S" + short_number(state.speed_factor, 1),
                "M221 S" + short_number(state.flow_factor, 1)});
  writer.heat();
}

void find_position(AsideWriter& writer, const Printer& printer, const LeadIn& to) {
  writer.lines({"G21", "G90", "G92 Z" + short_number(to.height, 3)});
  writer.height(height_aside(printer, to.height, to.state));
  writer.line("G28 X Y");
  writer.lines(modes());
  writer.lines(calibration(printer));
}

void mixtures(AsideWriter& writer, const ModalState& state) {
  for (const auto& [tool, definition] : state.tools) writer.lines(definition);
  writer.lines(state.collected());
  writer.select_mixture();
}

void squeeze_out(AsideWriter& writer, const Printer& printer, const LeadIn& to) {
  const auto place = place_beside(printer, to.extent);
  if (!place) {
    writer.chunk().warnings.push_back(
        "the bed has no room beside the part, so that no plastic is squeezed out before the print continues; "
        "the first beads may come out thin or in a former colour");
    return;
  }
  writer.travel(*place);
  writer.squeeze(transitions * (printer.dead_volume + printer.mixing_volume), to.flow);
  writer.draw_back();
}

}  // namespace

Chunk lead_in(const Printer& printer, const LeadIn& to) {
  assert(to.state.position[0] && to.state.position[1] && to.state.position[2] && !to.state.relative);
  AsideWriter writer(printer, to.state, to.drawn);
  heat(writer, to.state);
  find_position(writer, printer, to);
  mixtures(writer, to.state);
  squeeze_out(writer, printer, to);
  writer.approach();
  return writer.take();
}

}  // namespace unicursal::gcode
