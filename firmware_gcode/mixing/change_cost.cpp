#include "firmware_gcode/mixing/change_cost.hpp"

#include <numeric>

#include "firmware_gcode/mixing/forecast.hpp"

namespace unicursal::gcode {
namespace {

constexpr double room = 3;  ///< transitions: what a change needs on either side to be alone

/// Of a single change with its half-way point on the border, or hurried on. A gradient counts with its
/// middle.
double cost_of(const Palette& palette, const ChamberModel& chamber, std::size_t from, std::size_t to,
               const Overshoot* overshoot, const LayerMaterials& layer_materials) {
  const double volume = room * (chamber.dead_volume + chamber.mixing_volume) + 1;
  Forecast forecast(palette, chamber);
  forecast.add(WantedBead{volume, from, 0.5, 0, false, 0, layer_materials});  // fills the chamber
  forecast.add(WantedBead{volume, from, 0.5, 1, false, 0, layer_materials});
  forecast.add(WantedBead{volume, to, 0.5, 1, false, 0, layer_materials});
  forecast.add(Switch{0, palette.shade(from, 0.5)});
  double at = 2 * volume - (overshoot ? chamber.dead_volume + overshoot->lead : chamber.delay(0.5));
  for (std::size_t i = 0; overshoot && i < overshoot->pulses.size(); ++i) {
    forecast.add(Switch{at, overshoot->pulses[i].shade});
    at += overshoot->pulses[i].volume;
  }
  forecast.add(Switch{at, palette.shade(to, 0.5)});
  const LayerMixing mixing = forecast.rest().back();
  return mixing.misplaced + mixing.wrong;
}

}  // namespace

ChangeCosts::ChangeCosts(const Palette& palette, const ChamberModel& chamber,
                         const std::vector<bool>& matters, const Overshoots& overshoots)
    : palette_(palette), chamber_(chamber), overshoots_(overshoots), matters_(matters) {}

double ChangeCosts::of(std::size_t from, std::size_t to) const {
  if (from == to || !matters_[from] || !matters_[to]) return 0;
  const auto [cost, added] = known_.try_emplace({from, to}, 0);
  if (!added) return cost->second;
  std::vector<std::size_t> all(palette_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const auto layer_materials = std::make_shared<const std::vector<std::size_t>>(std::move(all));
  return cost->second = cost_of(palette_, chamber_, from, to, overshoots_.between(from, to), layer_materials);
}

}  // namespace unicursal::gcode
