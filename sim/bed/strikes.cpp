#include "sim/bed/strikes.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::sim {

namespace {

constexpr double fine_pitch = 1, coarse_pitch = 5;  // mm
constexpr double tip_step = 0.5, head_step = 2.5;   // mm between the places of a move that are looked at
constexpr double tolerance = 0.02;                  // mm of height, for rounding

std::uint64_t key(double x, double y, double pitch) {
  const auto column = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(x / pitch)));
  const auto row = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(y / pitch)));
  return (static_cast<std::uint64_t>(column) << 32) | row;
}

Position between(const Position& from, const Position& to, double part) {
  return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y), from.z + part * (to.z - from.z)};
}

/// Calls `look` with places at most `step` apart, both ends included, until it returns true.
template <class Look>
bool any_along(const Position& from, const Position& to, double step, const Look& look) {
  const double pieces = std::max(1.0, std::ceil(std::hypot(to.x - from.x, to.y - from.y) / step));
  for (double piece = 0; piece <= pieces; ++piece) {
    if (look(between(from, to, piece / pieces))) return true;
  }
  return false;
}

}  // namespace

void Strikes::laid(const Position& from, const Position& to) {
  check(from, to);
  highest_ = std::max(highest_, to.z);
  any_along(from, to, tip_step, [&](const Position& at) {
    double& top = fine_[key(at.x, at.y, fine_pitch)];
    top = std::max(top, at.z);
    if (!head_) return false;
    const auto [entry, first] =
        coarse_.try_emplace(key(at.x, at.y, coarse_pitch), Cell{at.z, at.x, at.y, at.x, at.y});
    Cell& cell = entry->second;
    cell = {std::max(cell.top, at.z), std::min(cell.min_x, at.x), std::min(cell.min_y, at.y),
            std::max(cell.max_x, at.x), std::max(cell.max_y, at.y)};
    return false;
  });
}

void Strikes::travelled(const Position& from, const Position& to) {
  check(from, to);
}

void Strikes::check(const Position& from, const Position& to) {
  if (std::min(from.z, to.z) + tolerance >= highest_) return;
  if (any_along(from, to, tip_step, [&](const Position& at) { return tip_strikes(at); }))
    return note(by_nozzle_, to);
  if (head_ && any_along(from, to, head_step, [&](const Position& at) { return head_strikes(at); }))
    note(by_head_, to);
}

bool Strikes::tip_strikes(const Position& at) const {
  const auto top = fine_.find(key(at.x, at.y, fine_pitch));
  return top != fine_.end() && top->second > at.z + tolerance;
}

bool Strikes::head_strikes(const Position& at) const {
  return std::any_of(coarse_.begin(), coarse_.end(), [&](const auto& entry) {
    const Cell& cell = entry.second;
    if (cell.top <= at.z + tolerance) return false;
    if (cell.top > at.z + head_->height + tolerance) return true;
    const double x = std::clamp(at.x, cell.min_x, cell.max_x), y = std::clamp(at.y, cell.min_y, cell.max_y);
    return std::hypot(at.x - x, at.y - y) < head_->radius;
  });
}

void Strikes::note(std::uint64_t& count, const Position& at) {
  ++count;
  if (!first_) first_ = at;
}

}  // namespace unicursal::sim
