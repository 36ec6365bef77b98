#include "sim/nozzle/feed_log.hpp"

#include <algorithm>

#include "sim/nozzle/nozzle.hpp"

namespace unicursal::sim {

namespace {

void add(PerFeeder<std::int64_t>& sum, const PerFeeder<std::int64_t>& steps) {
  for (std::size_t i = 0; i < max_feeders; ++i) sum[i] += steps[i];
}

}  // namespace

void FeedLog::moved(const ExecutedMove& move) {
  if (move.filament == 0) return;
  if (lays_bead(move)) {
    MixtureUse& use = use_of(move.mix);
    use.extruded += move.filament;
    add(use.feeder_steps, move.feeder_steps);
    extruded_ += move.filament;
  } else {
    (move.filament > 0 ? fed_in_place_ : retracted_) += std::abs(move.filament);
    add(idle_steps_, move.feeder_steps);
  }
}

MixtureUse& FeedLog::use_of(const Mix& mix) {
  const auto same = [&mix](const MixtureUse& use) { return use.mix.factors == mix.factors; };
  // The current mixture is most often the newest.
  const auto found = std::find_if(mixtures_.rbegin(), mixtures_.rend(), same);
  if (found != mixtures_.rend()) return *found;
  mixtures_.push_back({mix, 0, {}});
  return mixtures_.back();
}

}  // namespace unicursal::sim
