#include "firmware_gcode/dialect/reprapfirmware.hpp"

#include "firmware_gcode/dialect/number.hpp"

namespace unicursal::gcode {
namespace {

/// The shares of the feeders that the tool has; they add up to exactly one.
Mixture of_existing_feeders(const Mixture& mixture, int feeders, int decimals) {
  std::array<double, max_feeders> shares{};
  double sum = 0;
  for (std::size_t f = 0; f < static_cast<std::size_t>(feeders); ++f) sum += shares[f] = mixture.share(f);
  if (sum <= 0) shares[0] = 1;
  return Mixture(shares).quantised(decimals);
}

}  // namespace

const Limits& RepRapFirmware::limits() const {
  static const Limits limits;
  return limits;
}

std::string RepRapFirmware::write_shares(const Mixture& mixture, const Printer& printer) const {
  const int decimals = limits().mixture_decimals;
  const Mixture shares = of_existing_feeders(mixture, printer.feeders, decimals);
  std::string line = "M567 P0 E";
  for (std::size_t f = 0; f < static_cast<std::size_t>(printer.feeders); ++f)
    line += (f == 0 ? "" : ":") + short_number(shares.share(f), decimals);
  return line;
}

}  // namespace unicursal::gcode
