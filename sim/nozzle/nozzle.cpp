#include "sim/nozzle/nozzle.hpp"

#include <numbers>

namespace unicursal::sim {

namespace {

Position between(const Position& a, const Position& b, double part) {
  if (part >= 1) return b;
  const auto mix = [part](double from, double to) { return from + part * (to - from); };
  return {mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z)};
}

Bead bead_of(const ExecutedMove& move, const Outflow& flow) {
  Bead bead{between(move.from, move.to, flow.from), between(move.from, move.to, flow.to), flow.total()};
  for (std::size_t f = 0; f < max_feeders; ++f) bead.shares[f] = flow.volume[f] / bead.volume;
  bead.start = move.start + flow.from * (move.end - move.start);
  bead.end = move.start + flow.to * (move.end - move.start);
  return bead;
}

}  // namespace

Nozzle::Nozzle(double filament_diameter, const Chamber& chamber, BedSink& bed)
    : filament_area_(std::numbers::pi * filament_diameter * filament_diameter / 4),
      chamber_(chamber),
      bed_(bed) {}

void Nozzle::moved(const ExecutedMove& move) {
  PerFeeder<double> volume = shares_of(move.mix.factors);
  for (std::size_t f = 0; f < max_feeders; ++f) fed_[f] += volume[f] *= move.filament * filament_area_;
  const std::vector<Outflow> flows = chamber_.feed(volume);
  const double begin = flows.empty() ? 1 : flows.front().from;
  const Position first = between(move.from, move.to, begin);
  if (first.x != move.from.x || first.y != move.from.y) bed_.travelled(move.from, first);
  for (const Outflow& flow : flows) {
    if (flow.total() > 0) bed_.laid(bead_of(move, flow));
  }
}

}  // namespace unicursal::sim
