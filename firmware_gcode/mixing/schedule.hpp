// The schedule of the switches: turns the materials wanted along the path into the mixtures that the feeders
// deliver. The chamber responds late and gradually (chamber.hpp), so that every switch precedes its border.
//
// Method: the switches are the hidden inputs of a channel with memory, and are found like the bits of a
// distorted signal: by Viterbi's algorithm with a bounded number of survivors. The volume advances in small
// steps. At each step near a border, every survivor may switch to a material that is wanted soon, with an
// overshoot (overshoot.hpp) or without. The outflow of each survivor is compared with what is wanted there,
// and the most expensive survivors are dropped. As a result, the 50 % point of a single change lies on its
// border; around a short visit the switches move apart until the material shows; a visit that is too short to
// show is omitted if that misplaces less. A switch is certain when all survivors agree on it, at the latest
// after the `horizon`. The paper (§4.1) leaves its 6.1 mm³ to the zones; this schedule also works without
// zones for them. All volumes in mm³, fed since the beginning of the print.
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
  double before_border = 0.5;  ///< fraction of a change that lies before the border, 0.05…0.95
  bool look_ahead = true;      ///< false, for comparison: switch at the border
  /// Null: changes have no overshoots. Must outlive the schedule.
  const Overshoots* overshoots = nullptr;
  /// No switch precedes its border by more than the volume in which this fraction of the change arrives.
  /// Greater if the plastic before a border matters less than that behind it.
  double early = 0.95;
  double horizon = 1.5;  ///< mixing volumes after which a switch is final
};

/// From the volume `at` on, the feeders deliver `shade`.
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
  /// No bead will follow: all switches become certain.
  void end();
  /// The switches that have become certain since the last call, in order; the first one of the print is at 0.
  std::vector<Switch> take();
  /// The volume up to which all switches are certain.
  double certain() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::gcode
