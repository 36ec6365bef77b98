// What G-code's modal state makes of the numbers in a move: units, absolute or relative, the origin that G92
// shifts, feed rate, M220 and M221. Positions in mm in the machine's frame; E is the logical one (the sum of
// what was asked), while `filament` is what the feeders are to have fed since power-up.
#pragma once

#include <array>

#include "sim/line/words.hpp"
#include "sim/motion/planner.hpp"

namespace unicursal::sim {

/// Where a move goes and what it asks for.
struct MoveTarget {
  std::array<double, 3> place{};  ///< mm, machine's frame
  double e = 0;                   ///< mm, logical
  double speed = 0;               ///< mm/s along the move, M220 included
  bool held_at_edge = false;      ///< the bed's edge cut it short (software endstops)
};

class Coordinates {
 public:
  /// `bed`: mm; homed axes stay within it.
  explicit Coordinates(const std::array<double, 3>& bed) : bed_(bed) {}

  /// Also remembers F, as G0 and G1 do.
  MoveTarget target(const Command& command);
  void arrive(const MoveTarget& target);
  void shift_origin(const Command& command);  ///< G92

  void set_absolute(bool absolute) { absolute_ = absolute_e_ = absolute; }  ///< G90, G91: E too
  void set_absolute_e(bool absolute) { absolute_e_ = absolute; }            ///< M82, M83
  void set_inches(bool inches) { unit_ = inches ? 25.4 : 1; }
  void set_feed_percent(double percent) { feed_ = limited(percent); }
  void set_flow_percent(double percent) { flow_ = limited(percent); }

  /// Multiplies filament (M221).
  double flow() const { return flow_; }
  const std::array<double, 3>& place() const { return place_; }
  double e() const { return e_; }
  /// What M114 calls X, Y, Z.
  double logical(Axis axis) const { return place_[axis] - origin_[axis]; }

  void home(Axis axis);
  void forget_home() { homed_ = {}; }
  /// After an abrupt stop: where the machine really is.
  void stopped_at(const std::array<double, 3>& place, double e);

 private:
  static double limited(double percent);

  std::array<double, 3> bed_;
  std::array<double, 3> place_{}, origin_{};
  std::array<bool, 3> homed_{};
  double e_ = 0;
  double speed_ = 25;  ///< mm/s, until the first F
  double unit_ = 1, feed_ = 1, flow_ = 1;
  bool absolute_ = true, absolute_e_ = true;
};

}  // namespace unicursal::sim
