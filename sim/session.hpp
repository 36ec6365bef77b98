// Serves hosts that come and go at the pseudo-terminal, and runs the printer's clock: real time × speed, or
// leaps if the speed is 0. With leaps, printer time stands still while the host is silent and nothing is in
// progress, bytes take no time on the cable, and every wait is skipped: a full queue leaps to the end of its
// oldest move, a heater to its target. Such a run depends only on the bytes received, not on the computer's
// speed.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "sim/line/terminal.hpp"
#include "sim/printer.hpp"
#include "sim/simulator_options.hpp"
#include "sim/stop_signals.hpp"

namespace unicursal::sim {

class Session {
 public:
  /// Calls `ready` with the terminal's path, and again with the new path when the cable is plugged in again.
  Session(const SimulatorOptions& options, Printer& printer, std::function<void(const std::string&)> ready);

  /// Runs until a signal arrives or, with options.once, until the host hangs up.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  bool paced() const { return options_.speed > 0; }
  double present() const;
  int sleep_time() const;
  void keep_time();
  void leap();
  bool wait_for_host();
  void open();
  void serve();
  void wait_for_events(bool leaps);
  void replug();

  const SimulatorOptions& options_;
  Printer& printer_;
  std::function<void(const std::string&)> ready_;
  StopSignals stop_;
  std::unique_ptr<Terminal> terminal_;
  std::string output_;  ///< Replies that the terminal has not taken yet.
  Clock::time_point start_{};
  bool started_ = false, dtr_low_ = true, used_ = false, hung_up_ = false, stopped_ = false;
};

}  // namespace unicursal::sim
