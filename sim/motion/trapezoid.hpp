// The speed along one move: up from the entry speed, on at the nominal speed, down to the exit speed, at one
// acceleration. Where the move is too short to reach the nominal speed the plateau is missing.
// mm, mm/s, mm/s², s.
#pragma once

namespace unicursal::sim {

struct Trapezoid {
  double length = 0;
  double entry = 0, nominal = 0, exit = 0;
  double acceleration = 0;

  /// The highest speed reached.
  double peak() const;
  double seconds() const;
  /// How far the move has come `time` seconds after its start.
  double distance(double time) const;
  double speed_at(double time) const;
  /// What happens between two times, as a trapezoid of its own.
  Trapezoid part(double from, double to) const;
};

/// The speed from which `length` suffices to reach `end`, either way round.
double reachable_speed(double end, double acceleration, double length);

}  // namespace unicursal::sim
