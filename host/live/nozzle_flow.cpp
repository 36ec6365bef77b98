#include "host/live/nozzle_flow.hpp"

#include <algorithm>

#include "firmware_gcode/mixing/print_mixtures.hpp"

namespace unicursal::host {
namespace {

constexpr double no_void = 1e-9;  ///< mm³; rounding of E leaves as much

}  // namespace

NozzleFlow::NozzleFlow(const gcode::Printer& printer)
    : outflow_(gcode::chamber_of(printer), printer.feeders),
      voids_(gcode::PerFeeder::zeros(printer.feeders)) {}

void NozzleFlow::feed(const gcode::Shares& shares, double volume, const Leaves& leaves) {
  if (volume > 0 && !drawn_) return outflow_.feed(shares, volume, leaves);
  if (volume > 0) return fill_and_feed(shares, volume, leaves);
  for (std::size_t f = 0; f < voids_.size(); ++f) voids_[f] -= volume * shares[f];
  drawn_ = drawn_ || volume < 0;
}

void NozzleFlow::fill_and_feed(const gcode::Shares& shares, double volume, const Leaves& leaves) {
  gcode::Shares rest = shares;
  double sum = 0;
  drawn_ = false;
  for (std::size_t f = 0; f < voids_.size(); ++f) {
    const double pushed = shares[f] * volume, filled = std::min(pushed, voids_[f]);
    voids_[f] -= filled;
    if (voids_[f] < no_void) voids_[f] = 0;
    drawn_ = drawn_ || voids_[f] > 0;
    sum += rest[f] = pushed - filled;
  }
  if (sum < no_void) return;
  for (double& share : rest) share /= sum;
  outflow_.feed(rest, sum, leaves);
}

}  // namespace unicursal::host
