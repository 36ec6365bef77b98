// When to switch: from what is wanted along the path to the mixtures that the feeders are told, by volume
// ahead. The chamber answers late and slowly (response.hpp), so that every switch comes before the border
// that it is for.
//
// Method: the switches are the hidden sequence behind what comes out, so that they are found as a receiver
// finds the bits behind a smeared signal (Viterbi's algorithm with as many survivors as matter): volume goes
// on in small steps; at each step near a border every survivor may change to a material that is wanted soon;
// what then leaves the tanks is held against what is wanted there, and the dearest survivors are dropped.
// Thus the half-way point of a single change comes to lie on its border, for a short visit the switches move
// apart until it shows, and one that is too short to show is passed over, whichever misplaces least. A change
// that may be hurried on (overshoot.hpp) is weighed both ways, with its pulses and without. Switches
// are certain once all survivors agree on them, at the latest when `horizon` has passed. The paper (§4.1)
// leaves its 6.1 mm³ to the zones; this takes care of them where there is no zone for them. All volumes in
// mm³, fed since the beginning of the print.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "firmware_gcode/mixing/chamber.hpp"
#include "firmware_gcode/mixing/overshoot.hpp"
#include "firmware_gcode/mixing/palette.hpp"
#include "firmware_gcode/mixing/wanted.hpp"

namespace unicursal::gcode {

struct ScheduleOptions {
  ChamberModel chamber;
  double before_border = 0.5;  ///< the share of a change that falls before the border, 0.05…0.95
  bool look_ahead = true;      ///< false, for comparison: switch where the border is
  /// How changes may be hurried on; null: not at all. Must outlive the schedule.
  const Overshoots* overshoots = nullptr;
};

/// From `at` on the feeders mix `shade`.
struct Switch {
  double at = 0;
  Shade shade;
};

class Schedule {
 public:
  /// The palette must outlive this object.
  Schedule(const Palette& palette, const ScheduleOptions& options);
  ~Schedule();
  Schedule(Schedule&&) noexcept;

  void add(const WantedBead& piece);
  /// Nothing more will come: all becomes certain.
  void end();
  /// The switches that have become certain since the last call, in order; the first of all is at 0.
  std::vector<Switch> take();
  /// Up to where nothing will change any more.
  double certain() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::gcode
