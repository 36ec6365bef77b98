// Adds the wall and processor time of a scope to a stage.
#pragma once

#include <chrono>
#include <ctime>

#include "core/planner/island_plan.hpp"

namespace unicursal::core {

class Stopwatch {
 public:
  explicit Stopwatch(StageTime& stage)
      : stage_(stage), wall_(std::chrono::steady_clock::now()), cpu_(cpu()) {}
  ~Stopwatch() {
    stage_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
    stage_.cpu_seconds += cpu() - cpu_;
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  /// Processor time of this thread, s.
  static double cpu() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  StageTime& stage_;
  std::chrono::steady_clock::time_point wall_;
  double cpu_;
};

}  // namespace unicursal::core
