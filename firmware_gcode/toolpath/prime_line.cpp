#include "firmware_gcode/toolpath/prime_line.hpp"

#include <algorithm>
#include <array>

namespace unicursal::gcode {
namespace {

constexpr double edge_inset = 5;      ///< mm between the bed's edge and the line's middle; avoids clips
constexpr double part_clearance = 3;  ///< mm between the line's edge and the part
constexpr double least_width = 1.2;   ///< nozzle openings; thinner lines do not stick well
constexpr double transitions = 2;     ///< one brings 95 % of the new mixture, two are safe
constexpr double usual_purge = 4;     ///< mm³ of each feeder
constexpr double least_purge = 0.5;   ///< mm³; less moves nothing
constexpr double purged_share = 0.8;  ///< of the feeder whose inlet is purged
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

/// `purge`: mm³ of each feeder, less if the edge has no room.
PrimeLine line_along(const Edge& edge, const Printer& printer, double height, double purge) {
  const double prime = transitions * (printer.dead_volume + printer.mixing_volume);
  const auto feeders = static_cast<double>(printer.feeders);
  const double thinnest = least_width * printer.nozzle;
  const double widest = std::max(printer.bead_width_range[1], thinnest);
  const double room = edge.length * widest * height - prime;
  purge = std::min(purge, room / feeders);
  if (purge < least_purge) purge = 0;
  const double wanted = prime + feeders * purge;
  const double width = std::clamp(wanted / (edge.length * height), thinnest, widest);
  const double length = std::clamp(wanted / (width * height), shortest_line, edge.length);
  return {edge.start, edge.start + edge.direction * length, width, width * height * length, purge};
}

bool clear_of(const PrimeLine& line, const core::Box& extent) {
  const double margin = part_clearance + line.width / 2;
  const core::Vec2 low = line.from.cwiseMin(line.to), high = line.from.cwiseMax(line.to);
  return high.x() + margin < extent.min.x() || low.x() - margin > extent.max.x() ||
         high.y() + margin < extent.min.y() || low.y() - margin > extent.max.y();
}

}  // namespace

/// A line that purges is longer, so that another edge may be free for it, or none.
std::optional<PrimeLine> prime_line(const Printer& printer, const core::Box& extent, double height) {
  for (const double purge : {printer.purge_inlets ? usual_purge : 0.0, 0.0}) {
    for (const Edge& edge : inset_edges(printer)) {
      if (edge.length < shortest_line) continue;
      const PrimeLine line = line_along(edge, printer, height, purge);
      if (clear_of(line, extent)) return line;
    }
  }
  return std::nullopt;
}

Mixture purge_mixture(std::size_t feeder, std::size_t feeders) {
  Shares shares = Shares::all(feeders, (1 - purged_share) / static_cast<double>(feeders - 1));
  shares[feeder] = purged_share;
  return Mixture(shares);
}

}  // namespace unicursal::gcode
