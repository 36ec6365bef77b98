// What a schedule will make of the zones, layer by layer: the switches played through the model of the
// chamber. mm³. Volumes that nobody looks at (prime line) and zones that are there to take up changes do not
// count.
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
  /// In order.
  void add(const Switch& next);
  /// The layers that lie wholly before this volume; nothing is switched any more up to there.
  std::vector<LayerMixing> up_to(double certain);
  /// Those that are left, at the end.
  std::vector<LayerMixing> rest();

 private:
  void advance(double certain);
  void arrive(double to);
  void end_run();

  const Palette& palette_;
  ChamberModel chamber_;
  WantedRuns wanted_;
  std::deque<Switch> coming_;
  Tanks::Shares inflow_{1.0 / 3, 1.0 / 3, 1.0 / 3};
  Tanks tanks_;
  double at_ = 0;         ///< played so far, at the nozzle
  std::size_t here_ = 0;  ///< the run there
  double run_wrong_ = 0;  ///< of it
  LayerMixing layer_;
  std::vector<LayerMixing> finished_;
};

}  // namespace unicursal::gcode
