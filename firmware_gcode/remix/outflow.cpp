#include "firmware_gcode/remix/outflow.hpp"

#include <algorithm>

namespace unicursal::gcode {
namespace {

constexpr double step = 1.0 / 40;  ///< of the mixing volume
constexpr double finest = 0.05;    ///< mm³
constexpr double nothing = 1e-12;  ///< mm³

}  // namespace

Outflow::Outflow(const ChamberModel& chamber, std::size_t feeders)
    : longest_(std::max(step * chamber.mixing_volume, finest)),
      tanks_(chamber, Mixture::equal(feeders).shares()) {
  if (chamber.dead_volume > 0) plugs_.push_back({Mixture::equal(feeders).shares(), chamber.dead_volume});
}

void Outflow::feed(const Shares& shares, double volume,
                   const std::function<void(double volume, const Shares& shares)>& leaves) {
  if (!plugs_.empty() && plugs_.back().shares == shares)
    plugs_.back().volume += volume;
  else
    plugs_.push_back({shares, volume});
  for (double left = volume; left > nothing && !plugs_.empty();) {
    Plug& first = plugs_.front();
    const double piece = std::min({left, first.volume, longest_});
    if (piece > nothing) leaves(piece, tanks_.pass(first.shares, piece));
    left -= piece;
    first.volume -= piece;
    if (first.volume <= nothing) plugs_.pop_front();
  }
}

}  // namespace unicursal::gcode
