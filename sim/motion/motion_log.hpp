// Statistics of the motion: speed and flow over time, fill of the queue, starvations. mm, mm/s, mm³/s,
// printer seconds. Memory does not grow with the print: time is divided into at most 4096 equal spans, which
// are joined in pairs when more are needed; flows are counted in bins of half a percent; the positions of the
// first hundred starvations are kept.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "sim/motion/move.hpp"
#include "sim/motion/planner.hpp"

namespace unicursal::sim {

/// Sums over a span of time.
struct MotionSpan {
  double seconds = 0;   ///< Time in which beads were laid.
  double length = 0;    ///< Length of the beads.
  double volume = 0;    ///< Volume of the beads.
  double fastest = 0;   ///< Highest speed of a bead.
  double fill = 0;      ///< Queued moves of any kind × seconds.
  double observed = 0;  ///< Time over which `fill` was summed.
  std::size_t least_fill = Planner::usable_blocks;

  double mean_speed() const { return seconds > 0 ? length / seconds : 0; }
  double mean_fill() const { return observed > 0 ? fill / observed : 0; }
};

class MotionLog : public MoveSink {
 public:
  /// `filament_area` in mm².
  explicit MotionLog(double filament_area) : filament_area_(filament_area) {}

  void moved(const ExecutedMove& move) override;
  void starved(const Starvation& starvation) override;
  void queue_changed(double time, std::size_t queued) override;

  double seconds() const { return seconds_; }  ///< Time in which beads were laid.
  double length() const { return length_; }
  double mean_speed() const { return seconds_ > 0 ? length_ / seconds_ : 0; }

  /// Seconds by instantaneous flow; the key is the middle of a bin.
  std::map<double, double> flows() const;
  /// Seconds by mean flow over each whole second of laying beads, without stops and travels; the same bins.
  std::map<double, double> second_flows() const;

  std::uint64_t dry() const { return dry_; }      ///< Starvations with an empty queue.
  std::uint64_t hasty() const { return hasty_; }  ///< Stops because the next move came while it braked.
  double dry_seconds() const { return dry_seconds_; }
  const std::vector<Starvation>& starvations() const { return starvations_; }

  /// Seconds by number of queued moves, from the first bead on.
  const std::array<double, Planner::usable_blocks + 1>& fill() const { return fill_; }
  const std::vector<MotionSpan>& spans() const { return spans_; }
  double span_seconds() const { return span_seconds_; }
  double first_bead() const { return first_; }  ///< Start of the first span.

 private:
  using Bins = std::map<int, double>;

  MotionSpan& span_at(double time);
  void add_flow(const ExecutedMove& move, double volume);
  void add_second(double volume, double seconds);
  /// Calls `use` for the part of an interval that lies in each span.
  template <class Use>
  void each_span(double from, double to, const Use& use);

  double filament_area_;
  double seconds_ = 0, length_ = 0;
  Bins flows_, second_flows_;
  double second_volume_ = 0, second_filled_ = 0;  ///< Volume and time of the current second.
  std::uint64_t dry_ = 0, hasty_ = 0;
  double dry_seconds_ = 0;
  std::vector<Starvation> starvations_;
  std::array<double, Planner::usable_blocks + 1> fill_{};
  std::size_t queued_ = 0;
  double queued_since_ = 0;
  double first_ = -1;  ///< Start of the first bead; negative before it. Nothing is observed before.
  std::vector<MotionSpan> spans_;
  double span_seconds_ = 1;
};

}  // namespace unicursal::sim
