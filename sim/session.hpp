// Hosts that come and go at the pseudo-terminal, and the printer's clock meanwhile: real time times k; or,
// with speed 0, leaps. Then printer time stands still while the host is silent and nothing is under way, the
// cable takes no time, and what takes time is over at once: a full queue leaps to the end of its oldest move,
// a heater to its target. So such a run depends on the bytes received only, not on the computer's speed.
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
  /// `ready` gets the path of the terminal, and that of the new one whenever the cable comes back.
  Session(const SimulatorOptions& options, Printer& printer, std::function<void(const std::string&)> ready);

  /// Until a signal comes or, with `once`, the host hangs up.
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
  std::string output_;  ///< replies not yet written
  Clock::time_point start_{};
  bool started_ = false, dtr_low_ = true, used_ = false, hung_up_ = false, stopped_ = false;
};

}  // namespace unicursal::sim
