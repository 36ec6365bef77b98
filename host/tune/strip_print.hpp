// The G-code of the strip: first the ticks and numbers, in the first mixture, then the whole bead without a
// break, at a constant flow.
#pragma once

#include <array>
#include <cstddef>

#include "firmware_gcode/print/mixture.hpp"
#include "host/engine/stream.hpp"
#include "host/tune/strip.hpp"

namespace unicursal::host {

/// The feeders of the first and the second mixture, counted from 0.
struct StripFeeders {
  std::size_t from = 0, to = 1;
};

/// The mixtures as the firmware will mix them, indexed by Shade. Those between the first and the last lie on
/// a straight line between the two, so the reference lines have mixtures that really come out during the
/// change.
std::array<gcode::Mixture, shade_count> strip_mixtures(const gcode::Printer& printer,
                                                       const StripFeeders& feeders);

/// Throws core::DataError if the printer's profile is invalid.
FinishedPrint strip_print(const Strip& strip, const gcode::Printer& printer, const StripFeeders& feeders);

}  // namespace unicursal::host
