// A planning thread's place on the printer's clock, which in virtual time is its own. s.
#pragma once

#include <algorithm>
#include <ctime>
#include <optional>

#include "host/lookahead/planning_clock.hpp"

namespace unicursal::host {

inline double thread_cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// For the thread that made it.
class Timeline {
 public:
  explicit Timeline(const std::optional<PlanningClock>& pace) : pace_(pace) {}

  /// A step begins, which could not before `earliest`.
  void begin(double earliest) {
    virtual_ = std::max(virtual_, earliest);
    cpu_ = thread_cpu_seconds();
  }
  /// And ends. Returns what it has taken of the processor.
  double end() {
    const double spent = thread_cpu_seconds() - cpu_;
    if (is_virtual()) virtual_ += pace_->charge * spent;
    cpu_ += spent;
    return spent;
  }
  double now() const {
    if (!pace_) return 0;
    return is_virtual() ? virtual_ + pace_->charge * (thread_cpu_seconds() - cpu_) : pace_->now();
  }
  /// When the last step ended, in virtual time; 0 in any other.
  double ended() const { return is_virtual() ? virtual_ : 0; }

 private:
  bool is_virtual() const { return pace_ && !pace_->now; }

  const std::optional<PlanningClock>& pace_;
  double virtual_ = 0, cpu_ = 0;
};

}  // namespace unicursal::host
