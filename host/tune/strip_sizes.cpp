#include "host/tune/strip_sizes.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::host {
namespace {

/// mm to the edge of the bed: room for clips and for the ticks of turns; and as a share of a small bed.
constexpr double most_margin = 10, least_margin = 6, margin_part = 0.05;
/// Of the nozzle's opening: sticks to the bed and spreads fine beads.
constexpr double height_part = 1.0 / 3;
constexpr double finest = 0.75;         ///< nozzle openings; thinner beads are hard to see in a photo
constexpr double fattest = 2;           ///< nozzle openings; fatter beads are no longer even
constexpr double lines_per_tick = 0.6;  ///< greatest opening for ticks at a distance of 1 mm, mm

double margin(double side) {
  return std::clamp(margin_part * side, least_margin, most_margin);
}

}  // namespace

StripSizes::StripSizes(const gcode::Printer& printer)
    : left(margin(printer.bed[0])),
      right(printer.bed[0] - margin(printer.bed[0])),
      front(margin(printer.bed[1])),
      back(printer.bed[1] - margin(printer.bed[1])),
      layer_height(printer.nozzle * height_part),
      line(printer.nozzle) {
  const double opening = printer.nozzle;
  const double thin_width =
      std::min(printer.bead_width_range[1], std::max(printer.bead_width_range[0], finest * opening));
  fat_width = std::max(thin_width, std::min(printer.bead_width_range[1], fattest * opening));
  thin = thin_width * layer_height;
  fat = fat_width * layer_height;
  tick = std::max(1.0, std::ceil(opening / lines_per_tick - 1e-9));
  gap = fat_width / 2 + 1.2 * opening;
  plain_tick = 2.5 * opening;
  fifth_tick = 4 * opening;
  tenth_tick = 5 * opening;
  digit_width = 3 * opening;
  digit_height = 6 * opening;
  digit_step = 5 * opening;
  number_gap = 1.5 * opening;
}

}  // namespace unicursal::host
