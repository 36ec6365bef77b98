// Virtual time in lockstep with the host, over a Unix socket beside the pseudo-terminal. Printer time
// advances only while the host says that it waits. Then a run depends neither on this computer's speed nor on
// how its processes are scheduled: the same bytes at the same printer times give the same run.
//
// One line each way, numbers in decimal, times in ns since power-up:
//
//   host:     wait UNTIL BYTES      it waits until UNTIL (−1: for ever) and has written BYTES in all
//   printer:  at NOW BYTES          that time is now; BYTES in all have been handed to the host
//   printer:  at NOW BYTES gone     and the cable is pulled
//   printer:  at NOW BYTES idle     nothing will ever happen unless the host does something
//
// NOW is UNTIL, or earlier if something for the host to read came first. The host sets its clock to NOW,
// waits until it can read those bytes, does all there is to do, and waits again. It opens the terminal before
// its first `wait`, which counts as the opening of the line; closing the socket counts as hanging up.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "sim/host_wait.hpp"
#include "sim/line/terminal.hpp"
#include "sim/printer.hpp"
#include "sim/simulator_options.hpp"
#include "sim/stop_signals.hpp"

namespace unicursal::sim {

class Lockstep {
 public:
  /// `ready` gets the path of the terminal when both ends can be opened. Throws std::system_error when the
  /// socket cannot be made. Precondition: options.control.
  Lockstep(const SimulatorOptions& options, Printer& printer, std::function<void(const std::string&)> ready);
  ~Lockstep();
  Lockstep(const Lockstep&) = delete;
  Lockstep& operator=(const Lockstep&) = delete;

  /// Until a signal comes or, with `once`, the host hangs up.
  void run();

 private:
  void listen();
  bool accept_host();
  void serve();
  std::optional<HostWait> next_wait();
  bool advance(double until);
  std::optional<std::string> read_message();
  void take_bytes(std::uint64_t total);
  void take_rest();
  void answer();
  void hand_over(std::string bytes);
  bool readable(int descriptor);
  void replug();

  const SimulatorOptions& options_;
  Printer& printer_;
  std::function<void(const std::string&)> ready_;
  StopSignals stop_;
  std::unique_ptr<Terminal> terminal_;
  Descriptor listener_, host_;
  std::string pending_;  ///< of a message not yet complete
  std::uint64_t heard_ = 0, told_ = 0;
  bool dtr_low_ = true, used_ = false, stopped_ = false;
};

}  // namespace unicursal::sim
