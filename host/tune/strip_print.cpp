#include "host/tune/strip_print.hpp"

#include <fmt/format.h>

#include "firmware_gcode/dialect/dialect_named.hpp"
#include "host/tune/test_print.hpp"
#include "host/tune/transition_fit.hpp"

namespace unicursal::host {
namespace {

using gcode::Mixture;

Mixture blend(const Mixture& a, const Mixture& b, double part) {
  gcode::Shares shares = a.shares();
  for (std::size_t f = 0; f < shares.size(); ++f) {
    shares[f] = (1 - part) * a.share(f) + part * b.share(f);
  }
  return Mixture(shares);
}

}  // namespace

std::array<Mixture, shade_count> strip_mixtures(const gcode::Printer& printer, const StripFeeders& feeders) {
  const gcode::Dialect& dialect = gcode::dialect_named(printer.firmware);
  const Mixture from = feeder_alone(feeders.from, printer);
  const Mixture to = feeder_alone(feeders.to, printer);
  const auto part = [&](double share) { return dialect.as_written(blend(from, to, share)); };
  return {part(0), part(perception.began), part(perception.half), part(perception.stopped), part(1)};
}

FinishedPrint strip_print(const Strip& strip, const gcode::Printer& printer, const StripFeeders& feeders) {
  TestPrint test;
  test.title = fmt::format("a strip to read the transition from, feeder {} to feeder {}", feeders.from + 1,
                           feeders.to + 1);
  test.name = "the strip";
  test.layer_height = strip.layer_height;
  test.line_width = strip.line_width;
  const auto mixtures = strip_mixtures(printer, feeders);
  test.mixtures.assign(mixtures.begin(), mixtures.end());
  test.marks_mixture = static_cast<std::size_t>(Shade::from);
  TestBead bead{strip.start, {}};
  for (const StripMove& move : strip.bead)
    bead.moves.push_back({move.to, move.volume, static_cast<std::size_t>(move.shade)});
  TestBead purge{strip.purge_start, {}};
  for (const StripMove& move : strip.purge)
    purge.moves.push_back({move.to, move.volume, static_cast<std::size_t>(move.shade)});
  test.layers.push_back({{std::move(purge)}, strip.marks, {std::move(bead)}});
  return gcode_of(test, printer);
}

}  // namespace unicursal::host
