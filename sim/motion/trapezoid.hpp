// The speed along one move: it rises from the entry speed to the nominal speed, stays there, and falls to the
// exit speed, all at one acceleration. A move that is too short to reach the nominal speed has no plateau.
// mm, mm/s, mm/s², s.
#pragma once

namespace unicursal::sim {

struct Trapezoid {
  double length = 0;
  double entry = 0, nominal = 0, exit = 0;
  double acceleration = 0;

  /// The highest speed of the move.
  double peak() const;
  double seconds() const;
  /// The distance covered `time` seconds after the start.
  double distance(double time) const;
  double speed_at(double time) const;
  /// The part between two times, as a trapezoid of its own.
  Trapezoid part(double from, double to) const;
};

/// The highest speed from which the move can brake to `end` within `length`; equally, the highest speed that
/// it can reach from `end`.
double reachable_speed(double end, double acceleration, double length);

}  // namespace unicursal::sim
