#include "firmware_gcode/mixing/forecast.hpp"

#include <algorithm>
#include <utility>

namespace unicursal::gcode {
namespace {

constexpr double step = 1.0 / 40;  ///< of the mixing volume
constexpr double finest = 0.05;    ///< mm³
constexpr double same_place = 1e-9;
constexpr double counts = 1;  ///< least weight of plastic that counts

}  // namespace

Forecast::Forecast(const Palette& palette, const ChamberModel& chamber)
    : palette_(palette),
      chamber_(chamber),
      wanted_(palette),
      inflow_(Mixture::equal(palette.feeders()).shares()),
      tanks_(chamber, inflow_) {}

void Forecast::add(const WantedBead& piece) {
  wanted_.add(piece);
}

void Forecast::add(const Switch& next) {
  coming_.push_back(next);
}

std::vector<LayerMixing> Forecast::up_to(double certain) {
  advance(std::min(certain + chamber_.dead_volume, wanted_.end()));
  return std::exchange(finished_, {});
}

std::vector<LayerMixing> Forecast::rest() {
  advance(wanted_.end());
  if (here_ < wanted_.past()) end_run();
  finished_.push_back(layer_);
  return std::exchange(finished_, {});
}

void Forecast::advance(double to) {
  const double longest = std::max(step * chamber_.mixing_volume, finest);
  while (at_ < to - same_place) {
    double next = std::min(to, at_ + longest);
    if (!coming_.empty()) {
      const double change = coming_.front().at + chamber_.dead_volume;
      if (change <= at_ + same_place) {
        inflow_ = palette_.mixture(coming_.front().shade).shares();
        ++layer_.switches;
        coming_.pop_front();
        continue;
      }
      next = std::min(next, change);
    }
    const WantedRun& run = wanted_.run(here_);
    const bool ends = run.end <= next + same_place && here_ + 1 < wanted_.past();
    if (ends) next = std::max(run.end, at_);
    if (next > at_) arrive(next);
    if (ends) end_run();
  }
}

void Forecast::arrive(double to) {
  const double volume = to - at_;
  const WantedRun& run = wanted_.run(here_);
  if (layer_.layer != run.layer) {
    finished_.push_back(layer_);
    layer_ = {};
    layer_.layer = run.layer;
  }
  const Shares arrived = tanks_.pass(inflow_, volume);
  const Mismatch bad = mismatch(palette_, run, wanted_.shares(run, (at_ + to) / 2), arrived);
  if (bad.wrong) run_wrong_ += volume;
  if (run.weight >= counts) {
    layer_.misplaced += bad.misplaced * volume;
    if (bad.wrong) layer_.wrong += volume;
  }
  at_ = to;
}

void Forecast::end_run() {
  const WantedRun& run = wanted_.run(here_);
  const WantedRun* before = here_ > wanted_.first() ? &wanted_.run(here_ - 1) : nullptr;
  const WantedRun* after = here_ + 1 < wanted_.past() ? &wanted_.run(here_ + 1) : nullptr;
  const bool arrives = before && before->material != run.material;
  const bool leaves = after && after->material != run.material;
  if (leaves) ++layer_.changes;
  if (run.weight >= counts && arrives && leaves && 2 * run_wrong_ > run.volume()) {
    ++layer_.passed_over;
    layer_.passed_over_volume += run.volume();
  }
  if (run.takes_changes && arrives && leaves && before->material != after->material) {
    ++layer_.crossings;
    layer_.shortest_crossing = std::min(layer_.shortest_crossing, run.volume());
    if (run.volume() < chamber_.mixing_volume) ++layer_.short_crossings;
  }
  run_wrong_ = 0;
  wanted_.forget_before(here_);
  ++here_;
}

}  // namespace unicursal::gcode
