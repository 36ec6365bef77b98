#include "host/tune/reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace unicursal::host {
namespace {

void check(const Strip& strip, const StripReading& reading) {
  const auto ticks = [&](double along) { return along / strip.tick; };
  for (const double along : {reading.began, reading.half.value_or(reading.began), reading.stopped}) {
    if (along >= 0 && along <= strip.length()) continue;  // false for NaN
    throw core::DataError("", "tick", fmt::format("{:g} is not on the strip", ticks(along)),
                          fmt::format("its ticks are 0 to {:g}; if the colour still changes at the end, "
                                      "print again with a larger --range",
                                      ticks(strip.length())));
  }
  const double half = reading.half.value_or((reading.began + reading.stopped) / 2);
  if (reading.began < half && half < reading.stopped) return;
  throw core::DataError(
      "", "tick",
      fmt::format("{:g} to {:g}{} is not an order in which a colour can change", ticks(reading.began),
                  ticks(reading.stopped), reading.half ? fmt::format(" with half at {:g}", ticks(half)) : ""),
      "the colour begins to change first, is half changed later and stops last");
}

/// The distance to the next printed tick: half of it for rounding, half for the eye.
double doubt_at(const Strip& strip, double along) {
  constexpr double same = 1e-6;  // ticks
  const double ticks = along / strip.tick;
  const auto next = std::find_if(strip.marked.begin(), strip.marked.end(),
                                 [&](std::size_t tick) { return static_cast<double>(tick) > ticks + same; });
  const double above = next == strip.marked.end() ? strip.length() / strip.tick : static_cast<double>(*next);
  const auto last = std::find_if(strip.marked.rbegin(), strip.marked.rend(),
                                 [&](std::size_t tick) { return static_cast<double>(tick) < ticks - same; });
  const double below = last == strip.marked.rend() ? 0 : static_cast<double>(*last);
  const bool on_tick = std::any_of(strip.marked.begin(), strip.marked.end(), [&](std::size_t tick) {
    return std::abs(static_cast<double>(tick) - ticks) <= same;
  });
  return (above - below) * strip.tick / (on_tick ? 2 : 1);
}

VolumeRange range_at(const Strip& strip, double along) {
  const double doubt = doubt_at(strip, along);
  return {strip.at(std::max(0.0, along - doubt)).passed,
          strip.at(std::min(strip.length(), along + doubt)).passed};
}

}  // namespace

ReadVolumes volumes_of(const Strip& strip, const StripReading& reading) {
  check(strip, reading);
  ReadVolumes volumes{range_at(strip, reading.began), range_at(strip, reading.stopped), {}};
  if (reading.half) volumes.half = range_at(strip, *reading.half);
  return volumes;
}

double nearest_tick(const Strip& strip, double along) {
  const double ticks = along / strip.tick;
  const auto nearest =
      std::min_element(strip.marked.begin(), strip.marked.end(), [&](std::size_t a, std::size_t b) {
        return std::abs(static_cast<double>(a) - ticks) < std::abs(static_cast<double>(b) - ticks);
      });
  return static_cast<double>(*nearest) * strip.tick;
}

}  // namespace unicursal::host
