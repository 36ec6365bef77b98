// What a schedule will make of the zones, layer by layer: the switches played through the model of the
// chamber. mm³. Volumes that nobody looks at (prime line) and zones that are there to take up changes do not
// count.
#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <vector>

#include "firmware_gcode/mixing/schedule.hpp"

namespace unicursal::gcode {

struct LayerMixing {
  std::size_t layer = 0;
  std::size_t changes = 0;      ///< of material that the path wants
  std::size_t switches = 0;     ///< that the printer is told
  std::size_t passed_over = 0;  ///< visits of a material too short to show
  double passed_over_volume = 0;
  double misplaced = 0;             ///< plastic that will lie in the wrong zone
  double wrong = 0;                 ///< where what arrives is nearer to another material of the layer
  std::size_t crossings = 0;        ///< of zones that take up changes, from one material to another
  std::size_t short_crossings = 0;  ///< that hold less than the mixing volume
  double shortest_crossing = std::numeric_limits<double>::infinity();

  /// Everything but the layer's index.
  LayerMixing& operator+=(const LayerMixing& more);
};

class Forecast {
 public:
  Forecast(const Palette& palette, const ChamberModel& chamber);

  void add(const Piece& piece);
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
  Wanted wanted_;
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
