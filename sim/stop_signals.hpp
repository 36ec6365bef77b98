// SIGINT and SIGTERM as something that poll() can wait for. While one of these lives the signals end nothing
// by themselves; afterwards they do again what they did before. One at a time in a process.
#pragma once

#include <csignal>

#include "sim/line/terminal.hpp"

namespace unicursal::sim {

class StopSignals {
 public:
  /// Throws std::system_error.
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Becomes readable, and stays so, when a signal has come.
  int descriptor() const { return read_end_.get(); }

 private:
  Descriptor read_end_, write_end_;
  using Action = struct sigaction;
  Action old_interrupt_{}, old_terminate_{};
};

}  // namespace unicursal::sim
