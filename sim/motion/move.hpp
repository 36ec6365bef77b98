// What passes from the motion to the nozzle and from the nozzle to the bed. Lengths in mm, volumes in mm³,
// times in printer seconds since power-up; positions in the machine's frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/motion/trapezoid.hpp"

namespace unicursal::sim {

inline constexpr std::size_t max_feeders = 6;

/// One value for each feeder; those that the printer does not have stay zero.
template <class T>
using PerFeeder = std::array<T, max_feeders>;

/// What the firmware mixes by: integers relative to the largest one.
using Factors = PerFeeder<std::int32_t>;

struct Position {
  double x = 0, y = 0, z = 0;
  friend bool operator==(const Position&, const Position&) = default;
};

/// A mixture as it was attached to a move when that was planned.
struct Mix {
  int tool = 0;  ///< virtual tool
  Factors factors{};
};

/// A move that has been carried out. What the melt does is continuous, so `filament` is not rounded to steps:
/// over any number of moves it and the steps differ by less than one step.
struct ExecutedMove {
  Position from, to;
  double filament = 0;                     ///< mm fed by all feeders together, negative when retracted
  PerFeeder<std::int64_t> feeder_steps{};  ///< signed; add up to the steps of E
  Mix mix;
  double start = 0, end = 0;  ///< s
  Trapezoid speed;            ///< along the move, as it was run; of a stopped move, as it was meant
};

/// A move that lays a bead: it feeds forward and goes somewhere in the plane.
bool lays_bead(const ExecutedMove& move);

/// The nozzle stood still in mid-curve because the next move was not there in time.
struct Starvation {
  double time = 0;     ///< s, when it came to stand
  Position place;      ///< where
  double seconds = 0;  ///< until it went on
  bool dry = true;     ///< the queue was empty; otherwise the next move came while the last one was braking
};

/// Takes what the machine does, in the order in which it happens.
class MoveSink {
 public:
  virtual ~MoveSink() = default;
  virtual void moved(const ExecutedMove& move) = 0;
  virtual void starved(const Starvation&) {}
  /// From now on this many moves are planned and not yet done, the running one included.
  virtual void queue_changed(double /*time*/, std::size_t /*queued*/) {}
};

/// The shares of the feeders in a mixture; all zero for a mixture of zeros.
PerFeeder<double> shares_of(const Factors& factors);

}  // namespace unicursal::sim
