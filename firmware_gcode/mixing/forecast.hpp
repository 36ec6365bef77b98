// Predicts the result of a schedule, layer by layer, by playing the switches through the model of the
// chamber. mm³. The prime line, whose colour does not matter, and transition zones do not count.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "firmware_gcode/mixing/schedule.hpp"
#include "firmware_gcode/print/layer_mixing.hpp"

namespace unicursal::gcode {

class Forecast {
 public:
  Forecast(const Palette& palette, const ChamberModel& chamber);

  void add(const WantedBead& piece);
  /// Switches must be added in order.
  void add(const Switch& next);
  /// The layers that lie completely before this volume. All switches up to there must have been added.
  std::vector<LayerMixing> up_to(double certain);
  /// The remaining layers, at the end of the print.
  std::vector<LayerMixing> rest();

 private:
  void advance(double certain);
  void arrive(double to);
  void end_run();

  const Palette& palette_;
  ChamberModel chamber_;
  WantedRuns wanted_;
  std::deque<Switch> coming_;
  Shares inflow_;
  Tanks tanks_;
  double at_ = 0;         ///< volume at the nozzle up to which all is computed
  std::size_t here_ = 0;  ///< index of the run there
  double run_wrong_ = 0;  ///< wrong volume of that run
  LayerMixing layer_;
  std::vector<LayerMixing> finished_;
};

}  // namespace unicursal::gcode
