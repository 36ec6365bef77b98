// How long the planning of an island may take, so that the nozzle never waits for it.
//
// Two rules, the stricter of which counts. An island must be there when the nozzle needs it, less what still
// has to be done after the optimisers were told that it is enough. And it may take its share of what planning
// can sustain: a layer's printing time on every thread, less while the look-ahead is short, so that it grows
// again; more while it is long, half of what is beyond. So quality steps down layer by layer, not all at
// once. All times in s of the printer's clock, unless they are said to be of a processor.
#pragma once

#include <cstddef>
#include <limits>

namespace unicursal::host {

/// The need of an island that nothing waits for yet.
inline constexpr double no_hurry = std::numeric_limits<double>::infinity();

class Pacer {
 public:
  /// `rate`: s of the clock that a second of a thread's planning takes.
  Pacer(std::size_t threads, double rate) : threads_(static_cast<double>(threads)), rate_(rate) {}

  /// For an island that is begun `slack` before the nozzle needs its layer: how long it may take in all.
  /// `print`: s that the layer prints; `share`: of the layer's area, that the island has.
  double allowance(double slack, double print, double share) const;

  /// What comes after the optimisers have been told that it is enough. `cells`: area ÷ bead width².
  double tail(double cells) const { return rate_ * tail_per_cell_ * cells; }
  /// One that was told so took this long from there.
  void learn_tail(double cells, double seconds);

  /// Of the steps that an island's optimisers take when nobody hurries, the part that these are; at most 1.
  double part_of_full(double steps) const;
  /// Nobody hurried, and it were so many.
  void learn_full(double steps);

 private:
  double threads_, rate_;
  // As measured over the example jobs, until this job's own are known.
  double tail_per_cell_ = 1e-4;  ///< s of a processor
  double full_steps_ = 480;
  bool full_known_ = false;
};

}  // namespace unicursal::host
