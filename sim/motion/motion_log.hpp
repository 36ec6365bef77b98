// What the motion came to: speeds and flow over time, the queue's fill, starvations. mm, mm/s, mm³/s, printer
// seconds. Memory does not grow with the print: time lies in at most 4096 equal spans, which are joined in
// pairs when more would be needed; flows lie in bins of half a percent; of the starvations the first hundred
// are kept with their places.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "sim/motion/move.hpp"
#include "sim/motion/planner.hpp"

namespace unicursal::sim {

/// A span of time, of beads only.
struct MotionSpan {
  double seconds = 0;  ///< in which beads were laid
  double length = 0;   ///< of them
  double volume = 0;   ///< pushed
  double fastest = 0;
  double fill = 0;      ///< queued moves × seconds, whatever they do
  double observed = 0;  ///< seconds of it
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

  double seconds() const { return seconds_; }  ///< in which beads were laid
  double length() const { return length_; }
  double mean_speed() const { return seconds_ > 0 ? length_ / seconds_ : 0; }

  /// Seconds by flow at the instant, the key being the middle of its bin.
  std::map<double, double> flows() const;
  /// Volume pushed in each whole second of laying beads, stops and travels left out; the same kind of bins.
  std::map<double, double> second_flows() const;

  std::uint64_t dry() const { return dry_; }      ///< starvations with an empty queue
  std::uint64_t hasty() const { return hasty_; }  ///< stops because the next move came late
  double dry_seconds() const { return dry_seconds_; }
  const std::vector<Starvation>& starvations() const { return starvations_; }

  /// Seconds spent with so many moves queued, from the first bead on.
  const std::array<double, Planner::usable_blocks + 1>& fill() const { return fill_; }
  const std::vector<MotionSpan>& spans() const { return spans_; }
  double span_seconds() const { return span_seconds_; }
  double first_bead() const { return first_; }  ///< when the first span begins

 private:
  using Bins = std::map<int, double>;

  MotionSpan& span_at(double time);
  void add_flow(const ExecutedMove& move, double volume);
  void add_second(double volume, double seconds);
  /// Cuts a time into its parts by span.
  template <class Use>
  void each_span(double from, double to, const Use& use);

  double filament_area_;
  double seconds_ = 0, length_ = 0;
  Bins flows_, second_flows_;
  double second_volume_ = 0, second_filled_ = 0;  ///< of the present second
  std::uint64_t dry_ = 0, hasty_ = 0;
  double dry_seconds_ = 0;
  std::vector<Starvation> starvations_;
  std::array<double, Planner::usable_blocks + 1> fill_{};
  std::size_t queued_ = 0;
  double queued_since_ = 0;
  double first_ = -1;  ///< when the first bead began; negative: not yet. Nothing is observed before
  std::vector<MotionSpan> spans_;
  double span_seconds_ = 1;
};

}  // namespace unicursal::sim
