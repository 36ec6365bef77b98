#include "firmware_gcode/toolpath/prime_line.hpp"

#include <algorithm>
#include <array>

namespace unicursal::gcode {
namespace {

constexpr double edge_inset = 5;      ///< mm between the bed's edge and the line's middle; avoids clips
constexpr double part_clearance = 3;  ///< mm between the line's edge and the part
constexpr double least_width = 1.2;   ///< nozzle openings; thinner lines do not stick well
constexpr double transitions = 2;     ///< one brings 95 % of the new mixture, two are safe
constexpr double shortest_line = 20;  ///< mm; a bed edge shorter than this is not worth a line

struct Edge {
  core::Vec2 start, direction;
  double length;
};

std::array<Edge, 4> inset_edges(const Printer& printer) {
  const double x = printer.bed[0], y = printer.bed[1], i = edge_inset;
  return {Edge{{i, i}, {1, 0}, x - 2 * i}, Edge{{i, i}, {0, 1}, y - 2 * i},
          Edge{{i, y - i}, {1, 0}, x - 2 * i}, Edge{{x - i, i}, {0, 1}, y - 2 * i}};
}

PrimeLine line_along(const Edge& edge, const Printer& printer, double height) {
  const double wanted = transitions * (printer.dead_volume + printer.mixing_volume);
  const double widest = std::max(printer.bead_width_range[1], least_width * printer.nozzle);
  const double width = std::clamp(wanted / (edge.length * height), least_width * printer.nozzle, widest);
  const double length = std::clamp(wanted / (width * height), shortest_line, edge.length);
  return {edge.start, edge.start + edge.direction * length, width, width * height * length};
}

bool clear_of(const PrimeLine& line, const core::Box& extent) {
  const double margin = part_clearance + line.width / 2;
  const core::Vec2 low = line.from.cwiseMin(line.to), high = line.from.cwiseMax(line.to);
  return high.x() + margin < extent.min.x() || low.x() - margin > extent.max.x() ||
         high.y() + margin < extent.min.y() || low.y() - margin > extent.max.y();
}

}  // namespace

std::optional<PrimeLine> prime_line(const Printer& printer, const core::Box& extent, double height) {
  for (const Edge& edge : inset_edges(printer)) {
    if (edge.length < shortest_line) continue;
    const PrimeLine line = line_along(edge, printer, height);
    if (clear_of(line, extent)) return line;
  }
  return std::nullopt;
}

}  // namespace unicursal::gcode
