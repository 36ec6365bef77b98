// The strip as lines for a printer: first ticks and numbers, in the first mixture, then the bead in one go,
// at a constant flow.
#pragma once

#include <array>
#include <cstddef>

#include "firmware_gcode/print/mixture.hpp"
#include "host/engine/stream.hpp"
#include "host/tune/strip.hpp"

namespace unicursal::host {

/// Counted from 0.
struct StripFeeders {
  std::size_t from = 0, to = 1;
};

/// What the firmware will really mix, by Shade. Between the first and the last the shares go in a straight
/// line, so that the mixtures to compare with are those that come out on the way.
std::array<gcode::Mixture, shade_count> strip_mixtures(const gcode::Printer& printer,
                                                       const StripFeeders& feeders);

/// Throws core::DataError for a printer that makes no sense.
FinishedPrint strip_print(const Strip& strip, const gcode::Printer& printer, const StripFeeders& feeders);

}  // namespace unicursal::host
