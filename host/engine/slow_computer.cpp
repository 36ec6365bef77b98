#include "host/engine/slow_computer.hpp"

#include <algorithm>

namespace unicursal::host {

SlowComputer::SlowComputer(double factor, std::size_t threads, std::size_t ahead)
    : factor_(factor), threads_(static_cast<double>(std::max<std::size_t>(threads, 1))), ahead_(ahead) {}

double SlowComputer::ready(double cpu_seconds, double now) {
  const double opened = taken_.size() < ahead_ ? 0 : taken_.front();
  done_ = std::max(done_, opened) + factor_ * cpu_seconds / threads_;
  const double there = std::max(now, done_);
  taken_.push_back(there);
  if (taken_.size() > ahead_) taken_.pop_front();
  return there;
}

}  // namespace unicursal::host
