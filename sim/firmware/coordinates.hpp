// Turns the numbers of a move into a target according to G-code's modal state: units, absolute or relative,
// the origin that G92 shifts, feed rate, M220 and M221. Positions are in mm in the machine's frame. E is the
// logical one: the sum of what was asked for, not of what the feeders fed.
#pragma once

#include <array>

#include "sim/line/words.hpp"
#include "sim/motion/planner.hpp"

namespace unicursal::sim {

/// The end of a move and its speed.
struct MoveTarget {
  std::array<double, 3> place{};  ///< Position in the machine's frame, mm.
  double e = 0;                   ///< Logical E, mm.
  double speed = 0;               ///< Speed along the move, M220 included, mm/s.
  bool held_at_edge = false;      ///< Whether the software endstops held it at the bed's edge.
};

class Coordinates {
 public:
  /// `bed` is its size in mm; homed axes stay within it, or go below 0 as far as `overtravel` says for x and
  /// y.
  explicit Coordinates(const std::array<double, 3>& bed, const std::array<double, 2>& overtravel = {})
      : bed_(bed), least_{0 - overtravel[0], 0 - overtravel[1], 0} {}

  /// Returns the target of a G0 or G1, and remembers its F.
  MoveTarget target(const Command& command);
  void arrive(const MoveTarget& target);
  void shift_origin(const Command& command);  ///< G92

  void set_absolute(bool absolute) { absolute_ = absolute_e_ = absolute; }  ///< G90, G91; includes E.
  void set_absolute_e(bool absolute) { absolute_e_ = absolute; }            ///< M82, M83
  void set_inches(bool inches) { unit_ = inches ? 25.4 : 1; }
  void set_feed_percent(double percent) { feed_ = limited(percent); }
  void set_flow_percent(double percent) { flow_ = limited(percent); }

  bool homed(Axis axis) const { return homed_[axis]; }
  /// Factor of the speed (M220).
  double feed() const { return feed_; }
  /// Factor of the filament (M221).
  double flow() const { return flow_; }
  const std::array<double, 3>& place() const { return place_; }
  double e() const { return e_; }
  /// X, Y or Z as M114 reports it.
  double logical(Axis axis) const { return place_[axis] - origin_[axis]; }

  void home(Axis axis);
  /// The nozzle goes up by `rise`, mm.
  void raise(double rise) { place_[axis_z] += rise; }
  void forget_home() { homed_ = {}; }
  /// To be called after an abrupt stop, with the position that the machine has really reached.
  void stopped_at(const std::array<double, 3>& place, double e);

 private:
  static double limited(double percent);

  std::array<double, 3> bed_, least_;
  std::array<double, 3> place_{}, origin_{};
  std::array<bool, 3> homed_{};
  double e_ = 0;
  double speed_ = 25;  ///< The last F, mm/s; 25 before the first one.
  double unit_ = 1, feed_ = 1, flow_ = 1;
  bool absolute_ = true, absolute_e_ = true;
};

}  // namespace unicursal::sim
