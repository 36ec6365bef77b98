#include "firmware_gcode/mixing/change_cost.hpp"

#include <numeric>

#include "firmware_gcode/mixing/forecast.hpp"

namespace unicursal::gcode {
namespace {

constexpr double room = 3;  ///< transitions: what a change needs on either side to be alone

/// Of a single change with its half-way point on the border. A gradient counts with its middle.
double cost_of(const Palette& palette, const ChamberModel& chamber, std::size_t from, std::size_t to,
               const Rivals& rivals) {
  const double volume = room * (chamber.dead_volume + chamber.mixing_volume) + 1;
  Forecast forecast(palette, chamber);
  forecast.add(Piece{volume, from, 0.5, 0, false, 0, rivals});  // fills the chamber
  forecast.add(Piece{volume, from, 0.5, 1, false, 0, rivals});
  forecast.add(Piece{volume, to, 0.5, 1, false, 0, rivals});
  forecast.add(Switch{0, palette.shade(from, 0.5)});
  forecast.add(Switch{2 * volume - chamber.delay(0.5), palette.shade(to, 0.5)});
  const LayerMixing mixing = forecast.rest().back();
  return mixing.misplaced + mixing.wrong;
}

}  // namespace

ChangeCosts::ChangeCosts(const Palette& palette, const ChamberModel& chamber,
                         const std::vector<bool>& matters)
    : materials_(palette.size()), costs_(materials_ * materials_, 0) {
  std::vector<std::size_t> all(materials_);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const auto rivals = std::make_shared<const std::vector<std::size_t>>(std::move(all));
  for (std::size_t from = 0; from < materials_; ++from) {
    for (std::size_t to = 0; to < materials_; ++to) {
      if (from == to || !matters[from] || !matters[to]) continue;
      costs_[from * materials_ + to] = cost_of(palette, chamber, from, to, rivals);
    }
  }
}

}  // namespace unicursal::gcode
