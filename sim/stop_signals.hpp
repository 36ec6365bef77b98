// SIGINT and SIGTERM as a descriptor that poll() can wait for. While an object of this class exists, the
// signals do not end the process; its destructor restores the previous handlers, or ignores the signals if
// they had none. At most one object may exist in a process.
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

  /// Becomes readable when a signal arrives, and stays readable.
  int descriptor() const { return read_end_.get(); }

 private:
  Descriptor read_end_, write_end_;
  using Action = struct sigaction;
  Action old_interrupt_{}, old_terminate_{};
};

}  // namespace unicursal::sim
