// Limits how long the planning of an island may take, so that the nozzle never waits for it.
//
// The stricter of two rules counts. First, an island must be finished when the nozzle needs it, which
// includes the work after its optimisers have stopped (the tail). Second, it may take its share of the time
// that planning can sustain: a layer's printing time on every thread. While the look-ahead is short it may
// take less, so that the look-ahead grows again; while it is long, half of the surplus is added. So quality
// falls layer by layer, not all at once. Times are in s of the printer's clock, except where a comment says
// processor time.
#pragma once

#include <cstddef>
#include <limits>

namespace unicursal::host {

/// Slack of an island that the printer does not wait for.
inline constexpr double no_hurry = std::numeric_limits<double>::infinity();

class Pacer {
 public:
  /// `rate`: time on the clock for one second of a thread's planning, s.
  Pacer(std::size_t threads, double rate) : threads_(static_cast<double>(threads)), rate_(rate) {}

  /// Returns how long an island may take in all, if it is begun `slack` s before the nozzle needs its layer.
  /// `print`: printing time of the layer, s; `share`: the island's share of the layer's area.
  double allowance(double slack, double print, double share) const;

  /// Expected time that an island needs after its optimisers have stopped, s. `cells`: area ÷ bead width².
  double tail(double cells) const { return rate_ * tail_per_cell_ * cells; }
  /// Records that an island whose optimisers were stopped needed so many seconds after that.
  void learn_tail(double cells, double seconds);

  /// Returns `steps` as a share of the steps that an unhurried island takes, at most 1.
  double part_of_full(double steps) const;
  /// Records that an unhurried island took this many steps.
  void learn_full(double steps);

 private:
  double threads_, rate_;
  // Measured over the example jobs; used until values of this job are known.
  double tail_per_cell_ = 1e-4;  ///< processor time, s
  double full_steps_ = 480;
  bool full_known_ = false;
};

}  // namespace unicursal::host
