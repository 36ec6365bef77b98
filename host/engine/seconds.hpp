// Numbers of seconds as durations of a clock, and back.
#pragma once

#include <chrono>

#include "host/loop/clock.hpp"

namespace unicursal::host {

inline double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

inline Duration duration(double seconds) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

}  // namespace unicursal::host
