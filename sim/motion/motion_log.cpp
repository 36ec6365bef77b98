#include "sim/motion/motion_log.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::sim {

namespace {

constexpr double bin = 0.005;             // width in the logarithm of the flow
constexpr std::size_t most_spans = 4096;  // more are joined in pairs
constexpr std::size_t most_starvations = 100;
constexpr int ramp_parts = 8;  // number of speeds at which the flow of a ramp is taken
constexpr double second = 1;   // s over which flow is averaged

int bin_of(double flow) {
  return static_cast<int>(std::floor(std::log(std::max(flow, 1e-6)) / bin));
}

std::map<double, double> with_flows(const std::map<int, double>& bins) {
  std::map<double, double> result;
  for (const auto& [index, seconds] : bins) result[std::exp((index + 0.5) * bin)] = seconds;
  return result;
}

double way(const ExecutedMove& move) {
  return std::hypot(move.to.x - move.from.x, move.to.y - move.from.y, move.to.z - move.from.z);
}

MotionSpan joined(const MotionSpan& a, const MotionSpan& b) {
  MotionSpan both = a;
  both.seconds += b.seconds;
  both.length += b.length;
  both.volume += b.volume;
  both.fill += b.fill;
  both.observed += b.observed;
  both.fastest = std::max(a.fastest, b.fastest);
  both.least_fill = std::min(a.least_fill, b.least_fill);
  return both;
}

}  // namespace

template <class Use>
void MotionLog::each_span(double from, double to, const Use& use) {
  while (from < to) {
    MotionSpan& span = span_at(from);
    const double next = first_ + (std::floor((from - first_) / span_seconds_) + 1) * span_seconds_;
    // Rounding may yield no progress; then advance by the smallest step.
    const double end = std::min(to, std::max(next, std::nextafter(from, to)));
    use(span, end - from);
    from = end;
  }
}

MotionSpan& MotionLog::span_at(double time) {
  auto index = static_cast<std::size_t>(std::max(0.0, time - first_) / span_seconds_);
  while (index >= most_spans) {
    if (spans_.size() % 2 != 0) spans_.emplace_back();
    for (std::size_t i = 0; i < spans_.size() / 2; ++i) spans_[i] = joined(spans_[2 * i], spans_[2 * i + 1]);
    spans_.resize(spans_.size() / 2);
    span_seconds_ *= 2;
    index /= 2;
  }
  if (index >= spans_.size()) spans_.resize(index + 1);
  return spans_[index];
}

void MotionLog::moved(const ExecutedMove& move) {
  if (!lays_bead(move)) return;
  if (first_ < 0) first_ = queued_since_ = move.start;
  const double volume = move.filament * filament_area_, time = move.end - move.start, length = way(move);
  seconds_ += time;
  length_ += length;
  add_flow(move, volume);
  add_second(volume, time);
  // A long move extends over several spans; its speed is treated as constant.
  each_span(move.start, move.end, [&](MotionSpan& span, double part) {
    span.seconds += part;
    span.length += part / time * length;
    span.volume += part / time * volume;
    span.fastest = std::max(span.fastest, move.speed.peak());
  });
}

/// Divides the ramps into steps of equal time; the plateau is one step.
void MotionLog::add_flow(const ExecutedMove& move, double volume) {
  const Trapezoid& speed = move.speed;
  const double per_mm = volume / speed.length, top = speed.peak();
  double left = speed.seconds();
  for (const double end : {speed.entry, speed.exit}) {
    const double ramp = (top - end) / speed.acceleration;
    left -= ramp;
    for (int i = 0; i < ramp_parts && ramp > 0; ++i) {
      flows_[bin_of(per_mm * (end + (top - end) * (i + 0.5) / ramp_parts))] += ramp / ramp_parts;
    }
  }
  if (left > 0) flows_[bin_of(per_mm * top)] += left;
}

void MotionLog::add_second(double volume, double seconds) {
  const double flow = volume / seconds;
  while (seconds > 0) {
    const double part = std::min(seconds, second - second_filled_);
    second_filled_ += part;
    second_volume_ += part * flow;
    seconds -= part;
    if (second_filled_ < second * (1 - 1e-12)) return;
    second_flows_[bin_of(second_volume_ / second_filled_)] += second_filled_;
    second_filled_ = second_volume_ = 0;
  }
}

void MotionLog::starved(const Starvation& starvation) {
  ++(starvation.dry ? dry_ : hasty_);
  dry_seconds_ += starvation.seconds;
  if (starvations_.size() < most_starvations) starvations_.push_back(starvation);
}

void MotionLog::queue_changed(double time, std::size_t queued) {
  if (first_ >= 0 && time > queued_since_) {
    fill_[std::min(queued_, fill_.size() - 1)] += time - queued_since_;
    each_span(queued_since_, time, [&](MotionSpan& span, double part) {
      span.fill += static_cast<double>(queued_) * part;
      span.observed += part;
      span.least_fill = std::min(span.least_fill, queued_);
    });
    queued_since_ = time;
  }
  queued_ = queued;
}

std::map<double, double> MotionLog::flows() const {
  return with_flows(flows_);
}

std::map<double, double> MotionLog::second_flows() const {
  return with_flows(second_flows_);
}

}  // namespace unicursal::sim
