// Planning ahead of the nozzle: layers are sliced and planned on worker threads of lower priority and
// handed over in order. At most `ahead` layers are open or waiting at any time, so memory does not grow
// with the height of the part. The result does not depend on the number of threads.
//
//   Lookahead lookahead(*part, options);
//   while (std::optional<PlannedLayer> layer = lookahead.wait()) use(*layer);
#pragma once

#include <asio/awaitable.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/model/part.hpp"
#include "core/planner/plan_island.hpp"

namespace unicursal::host {

struct PlannedLayer {
  core::Layer layer;
  std::vector<core::IslandPlan> plans;  ///< one for each island, in the same order
  double cpu_seconds = 0;               ///< that slicing and planning it have cost
};

struct LookaheadOptions {
  core::PlanOptions plan;  ///< `seed` is the job's; every island gets its own, made from it
  std::shared_ptr<const core::IslandPlanner> planner;  ///< of the part's zones; made from them when absent
  std::size_t first = 0;                               ///< index of the first layer to plan
  std::size_t count = 0;                               ///< how many layers from there
  double flow = 0;          ///< mm³/s, by which the time that a layer prints is foretold; 0: unknown
  std::size_t threads = 0;  ///< 0: one for each core
  std::size_t ahead = 0;    ///< layers that may be open or waiting; 0: two more than threads
};

/// Layers that are planned and not yet taken.
struct Waiting {
  std::size_t layers = 0;
  double seconds = 0;  ///< of printing
};

/// What planning has cost so far.
struct PlanningEffort {
  double seconds = 0;      ///< during which at least one thread was slicing or planning
  double cpu_seconds = 0;  ///< of all threads together
};

/// The seed of one island's random jitter: layers differ, so that gaps do not line up through the height.
std::uint64_t island_seed(std::uint64_t job_seed, std::size_t layer, std::size_t island);

class Lookahead {
 public:
  /// `part` must outlive this object.
  Lookahead(const core::Part& part, const LookaheadOptions& options);
  /// Waits for the islands being planned; planning one cannot be interrupted.
  ~Lookahead();

  /// The next layer, or nothing after the last and after cancel(). Rethrows what slicing or planning threw,
  /// when its turn has come. Blocks; one caller at a time.
  std::optional<PlannedLayer> wait();
  /// The layer that is next, left where it is; null after the last. Otherwise like wait(). Valid until it is
  /// taken.
  const PlannedLayer* peek();
  /// The same as wait() for a coroutine. Precondition: its executor runs on one thread.
  asio::awaitable<std::optional<PlannedLayer>> next();

  /// No further island is begun; who waits is woken. From any thread.
  void cancel();

  PlanningEffort effort() const;
  Waiting waiting() const;
  std::size_t threads() const;
  /// Layers that may be open or waiting.
  std::size_t ahead() const;
  /// The greatest number of layers that were open or waiting at once.
  std::size_t most_open() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::host
