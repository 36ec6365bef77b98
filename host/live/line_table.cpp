#include "host/live/line_table.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::host {
namespace {

constexpr double whole = 65535;          ///< of a share
constexpr std::size_t kept_steps = 128;  ///< before the nozzle: more than any queue

}  // namespace

void LineTable::leave(double volume, const gcode::Shares& shares) {
  Poured piece;
  piece.middle = poured_ + volume / 2;
  for (std::size_t f = 0; f < shares.size(); ++f)
    piece.shares.at(f) = static_cast<std::uint16_t>(std::lround(std::clamp(shares[f], 0.0, 1.0) * whole));
  pieces_.push_back(piece);
  poured_ += volume;
}

void LineTable::add(LineStep step) {
  step.poured = poured_;
  step.end = (steps_.empty() ? before_ : steps_.back().end) + static_cast<double>(step.seconds);
  if (step.lays && last_fed_ != step.fed) {
    changes_.push_back(step.line);
    last_fed_ = step.fed;
  }
  steps_.push_back(step);
}

/// The first step that is not before the line.
std::size_t LineTable::at(std::uint64_t line) const {
  const auto found = std::lower_bound(steps_.begin(), steps_.end(), line,
                                      [](const LineStep& step, std::uint64_t of) { return step.line < of; });
  return static_cast<std::size_t>(found - steps_.begin());
}

double LineTable::begin_of(std::size_t index) const {
  return index == 0 ? before_ : steps_[index - 1].end;
}

void LineTable::back_to(std::uint64_t line, double poured) {
  poured_ = poured;
  while (!pieces_.empty() && pieces_.back().middle > poured) pieces_.pop_back();
  steps_.resize(at(line));
  while (!changes_.empty() && changes_.back() >= line) changes_.pop_back();
  last_fed_.reset();
  for (auto step = steps_.rbegin(); step != steps_.rend() && !last_fed_; ++step)
    if (step->lays) last_fed_ = step->fed;
}

void LineTable::stretch(std::uint64_t line, double factor) {
  const std::size_t first = at(line);
  for (std::size_t i = first; i < steps_.size(); ++i) {
    steps_[i].seconds *= static_cast<float>(factor);
    steps_[i].end = begin_of(i) + static_cast<double>(steps_[i].seconds);
  }
}

double LineTable::seconds_from(std::uint64_t line) const {
  return steps_.empty() ? 0 : steps_.back().end - begin_of(at(line));
}

void LineTable::drop_before(std::uint64_t line) {
  const std::size_t first = at(line);
  for (std::size_t i = kept_steps; i < first; ++i) {
    before_ = steps_.front().end;
    dropped_ = steps_.front().line;
    steps_.pop_front();
  }
  if (steps_.empty()) return;
  const double needed = steps_.front().poured - static_cast<double>(steps_.front().volume);
  while (pieces_.size() > 1 && pieces_[1].middle < needed) pieces_.pop_front();
  while (!changes_.empty() && changes_.front() < steps_.front().line) changes_.pop_front();
}

/// The step at `time_`. Precondition: there are steps.
std::size_t LineTable::at_time() const {
  const auto found = std::lower_bound(steps_.begin(), steps_.end(), time_,
                                      [](const LineStep& step, double time) { return step.end < time; });
  return std::min(static_cast<std::size_t>(found - steps_.begin()), steps_.size() - 1);
}

std::optional<LineTable::Where> LineTable::look(const LinePlace& place, TimePoint now, double speed) {
  const std::size_t queued_end = at(place.acknowledged);  // the steps before it were acknowledged
  if (queued_end == 0) return std::nullopt;
  const double latest = steps_[queued_end - 1].end;
  const auto begins = [&](std::size_t moves) {
    return begin_of(queued_end > moves ? queued_end - moves : 0);
  };
  if (looked_) time_ += std::chrono::duration<double>(now - *looked_).count() * speed / 100;
  const bool fresh = acknowledged_ != place.acknowledged || queued_ != place.queued_moves;
  if (place.queued_moves) {
    const std::size_t moves = *place.queued_moves;
    const double runs_from = begins(moves);
    const double runs_to = moves > 0 && fresh ? begins(moves - 1) : latest;
    time_ = std::clamp(time_, runs_from, std::max(runs_from, runs_to));
  } else {
    time_ = std::clamp(time_, begins(longest_queue_), latest);
  }
  looked_ = now;
  acknowledged_ = place.acknowledged;
  queued_ = place.queued_moves;
  const std::size_t index = at_time();
  Where where;
  where.step = &steps_[index];
  if (index > 0) where.before = &steps_[index - 1];
  const double begin = begin_of(index), length = steps_[index].end - begin;
  where.part = length > 0 ? std::clamp((time_ - begin) / length, 0.0, 1.0) : 1;
  return where;
}

/// Between the middles of two pieces the shares are taken to change evenly.
gcode::Shares LineTable::leaving(const Where& where, std::size_t feeders) const {
  if (pieces_.empty()) return gcode::Mixture::equal(feeders).shares();
  const double here = where.step->poured - (1 - where.part) * static_cast<double>(where.step->volume);
  auto next = std::lower_bound(pieces_.begin(), pieces_.end(), here,
                               [](const Poured& piece, double at) { return piece.middle < at; });
  if (next == pieces_.end()) --next;
  const auto before = next == pieces_.begin() ? next : next - 1;
  const double gap = next->middle - before->middle;
  const double part = gap > 0 ? std::clamp((here - before->middle) / gap, 0.0, 1.0) : 1;
  gcode::Shares shares = gcode::Shares::zeros(feeders);
  double sum = 0;
  for (std::size_t f = 0; f < feeders; ++f) {
    const double from = before->shares.at(f), to = next->shares.at(f);
    sum += shares[f] = from + part * (to - from);
  }
  for (double& share : shares) share /= sum > 0 ? sum : 1;
  return shares;
}

std::optional<LineTable::Change> LineTable::next_change(double speed) const {
  if (steps_.empty()) return std::nullopt;
  const std::uint64_t here = steps_[at_time()].line;
  const auto next = std::upper_bound(changes_.begin(), changes_.end(), here);
  if (next == changes_.end()) return std::nullopt;
  const std::size_t index = at(*next);
  if (index >= steps_.size()) return std::nullopt;
  return Change{std::max(begin_of(index) - time_, 0.0) * 100 / speed, steps_[index].fed};
}

}  // namespace unicursal::host
