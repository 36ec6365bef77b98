// Plans ahead of the nozzle. Worker threads of lower priority slice and plan layers, which are handed over in
// order. The number of layers, and of seconds of printing, that are being planned or waiting is bounded, so
// memory does not grow with the height of the part. The result does not depend on the number of threads.
//
// With a `pace`, every island gets the time that the printing of earlier layers leaves (pacer.hpp), and the
// caller reports the printer's progress with printed(). In virtual time the printer's clock stands still
// while this computer plans. Each thread then has a clock of its own, which planning advances by `charge`
// times the time it took, and PlannedLayer::ready_at is the time at which the layer would have been ready.
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
  core::PlanOptions plan;  ///< `seed` is that of the job; every island gets its own, derived from it
  std::shared_ptr<const core::IslandPlanner> planner;  ///< for the part's zones; created if null
  std::size_t first = 0;                               ///< index of the first layer to plan
  std::size_t count = 0;                               ///< number of layers to plan
  std::size_t threads = 0;                             ///< 0: one per core
  double flow = 0;  ///< mm³/s, to estimate how long a layer prints; 0: unknown
  /// Printing time that is planned ahead if the flow is known, s. At least one layer more than there are
  /// threads is always open, so that the threads have work. 0: only `ahead` limits the layers.
  double horizon = 0;
  std::size_t ahead = 0;  ///< most layers open or waiting; 0: default_ahead(), or most_ahead with a horizon
  std::optional<PlanningClock> pace;  ///< absent: every island takes as long as it needs
  bool patient = false;  ///< every island takes as long as it needs even with a pace; the nozzle may wait
};

/// Most layers that are open without a horizon in seconds.
constexpr std::size_t default_ahead(std::size_t threads) {
  return threads + 2;
}
/// Most layers that are open with a horizon: bounds memory if layers print in almost no time.
inline constexpr std::size_t most_ahead = 64;

/// The seed of the random numbers of one island. Layers get different seeds, so that gaps do not line up.
std::uint64_t island_seed(std::uint64_t job_seed, std::size_t layer, std::size_t island);

class Lookahead {
 public:
  /// `part` must outlive this object.
  Lookahead(const core::Part& part, const LookaheadOptions& options);
  /// As cancel(), and waits for the threads.
  ~Lookahead();

  /// Waits for the next layer. Returns nullopt after the last one and after cancel(). Rethrows an exception
  /// of slicing or planning when it is that layer's turn. One caller at a time.
  std::optional<PlannedLayer> wait();
  /// Whether wait() would return at once.
  bool ready() const;
  /// Sets a function that is called, mostly by a planning thread, when ready() may have become true. It must
  /// not call back. After on_ready({}) has returned, it is not called any more.
  void on_ready(std::function<void()> listener);
  /// Sets a function that a planning thread calls, without a lock, with each layer of waiting(), also with
  /// those that wait already; two threads may do so at once. It must be quick and not throw: a layer is not
  /// handed over meanwhile. After on_planned({}) has returned, it is not called any more.
  void on_planned(std::function<void(const PlannedLayer&)> viewer);

  /// Reports that at time `now` the printer has `left` s of printing before it needs the next layer. Until
  /// the first report islands have unlimited time. May be called from any thread.
  void printed(double now, double left);

  /// Begins no further island and gives up those being planned, within a second; wakes a caller of wait().
  /// May be called from any thread.
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
