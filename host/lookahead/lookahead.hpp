// Planning ahead of the nozzle: layers are sliced and planned on worker threads of lower priority and
// handed over in order. Only so many layers, and so many seconds of printing, are open or waiting at any
// time: memory does not grow with the height of the part. The result does not depend on the number of
// threads.
//
// With a `pace`, every island gets the time that the printing of earlier layers leaves (pacer.hpp); whoever
// prints tells where the printer is. In virtual time, the printer's clock stands still while this computer
// plans: every thread then keeps a time of its own, which planning moves by `charge` times what it took, and
// a layer tells when it would have been there.
//
//   Lookahead lookahead(*part, options);
//   while (std::optional<PlannedLayer> layer = lookahead.wait()) use(*layer);
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/model/part.hpp"
#include "core/planner/plan_island.hpp"
#include "host/lookahead/planned_layer.hpp"
#include "host/lookahead/planning_clock.hpp"

namespace unicursal::host {

struct LookaheadOptions {
  core::PlanOptions plan;  ///< `seed` is the job's; every island gets its own, made from it
  std::shared_ptr<const core::IslandPlanner> planner;  ///< of the part's zones; made from them when absent
  std::size_t first = 0;                               ///< index of the first layer to plan
  std::size_t count = 0;                               ///< how many layers from there
  std::size_t threads = 0;                             ///< 0: one for each core
  double flow = 0;  ///< mm³/s, by which the time that a layer prints is foretold; 0: unknown
  /// s of printing that are planned ahead, where the flow is known; but always one layer more than threads,
  /// so that these have work. 0: as many layers as may be open.
  double horizon = 0;
  std::size_t ahead = 0;  ///< layers that may be open or waiting; 0: default_ahead(), or most_ahead
  std::optional<PlanningClock> pace;  ///< absent: every island takes as long as it needs
  bool patient = false;               ///< it does so with a pace as well: the nozzle may wait
};

/// Layers that may be open when there is no horizon in seconds.
constexpr std::size_t default_ahead(std::size_t threads) {
  return threads + 2;
}
/// And when there is one: what bounds memory for layers that print in no time.
inline constexpr std::size_t most_ahead = 64;

/// The seed of one island's random jitter: layers differ, so that gaps do not line up through the height.
std::uint64_t island_seed(std::uint64_t job_seed, std::size_t layer, std::size_t island);

class Lookahead {
 public:
  /// `part` must outlive this object.
  Lookahead(const core::Part& part, const LookaheadOptions& options);
  /// Islands that are being planned are dropped at their next step.
  ~Lookahead();

  /// The next layer, or nothing after the last and after cancel(). Rethrows what slicing or planning threw,
  /// when its turn has come. Blocks; one caller at a time.
  std::optional<PlannedLayer> wait();
  /// Whether wait() would return at once.
  bool ready() const;
  /// Called, mostly by a planning thread, when ready() may have become true; not any more once this returns
  /// with an empty one. It must not call back.
  void on_ready(std::function<void()> listener);

  /// The printer has, at `now`, `left` s of printing before it needs the next layer. Until this is told for
  /// the first time nobody hurries. From any thread.
  void printed(double now, double left);

  /// No further island is begun, those at work end soon; who waits is woken. From any thread.
  void cancel();

  PlanningEffort effort() const;
  Waiting waiting() const;
  std::size_t threads() const;
  /// The greatest number of layers that were open or waiting at once.
  std::size_t most_open() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::host
