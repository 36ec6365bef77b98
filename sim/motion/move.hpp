// The values that motion, nozzle and bed exchange. Lengths in mm, volumes in mm³, times in printer seconds
// since power-up; positions in the machine's frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/motion/trapezoid.hpp"

namespace unicursal::sim {

inline constexpr std::size_t max_feeders = 8;

/// One value for each feeder; feeders that the printer does not have stay zero.
template <class T>
using PerFeeder = std::array<T, max_feeders>;

/// The firmware's factors of a mixture: integers relative to the largest one.
using Factors = PerFeeder<std::int32_t>;

struct Position {
  double x = 0, y = 0, z = 0;
  friend bool operator==(const Position&, const Position&) = default;
};

/// A mixture as it was attached to a move when the move was planned.
struct Mix {
  int tool = 0;  ///< Virtual tool.
  Factors factors{};
};

/// A move, or a part of one, that has been carried out. Melt flows continuously, so `filament` is not rounded
/// to steps: over any number of moves the two differ by less than one step.
struct ExecutedMove {
  Position from, to;
  double filament = 0;                     ///< Filament of all feeders together, mm; negative = retracted.
  PerFeeder<std::int64_t> feeder_steps{};  ///< Signed; the sum is the number of steps of E.
  Mix mix;
  double start = 0, end = 0;  ///< s.
  Trapezoid speed;            ///< Speed along the move (or part) as it was run.
};

/// Whether a move lays a bead: it feeds forward and moves in the xy plane.
bool lays_bead(const ExecutedMove& move);

/// A stop of the nozzle in mid-curve because the next move did not arrive in time.
struct Starvation {
  double time = 0;     ///< Start of the stop, s.
  Position place;      ///< Position of the nozzle.
  double seconds = 0;  ///< Duration.
  bool dry = true;     ///< Whether the queue was empty; if not, the next move came while the last one braked.
};

/// Receives everything that the machine does, in order.
class MoveSink {
 public:
  virtual ~MoveSink() = default;
  virtual void moved(const ExecutedMove& move) = 0;
  virtual void starved(const Starvation&) {}
  /// From now on `queued` moves are planned and not yet done, the running one included.
  virtual void queue_changed(double /*time*/, std::size_t /*queued*/) {}
};

/// The shares of the feeders in a mixture; all zero if all factors are zero.
PerFeeder<double> shares_of(const Factors& factors);

}  // namespace unicursal::sim
