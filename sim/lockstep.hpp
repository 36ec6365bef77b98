// Virtual time in lockstep with the host, over a Unix socket beside the pseudo-terminal. Printer time
// advances only while the host says that it waits. A run therefore depends neither on this computer's speed
// nor on the scheduling of its processes: the same bytes at the same printer times give the same run.
//
// One line in each direction, numbers in decimal, times in ns since power-up:
//
//   host:     wait UNTIL BYTES      the host waits until UNTIL (−1: for ever); it has written BYTES so far
//   printer:  at NOW BYTES          the time is NOW; BYTES have been handed to the host so far
//   printer:  at NOW BYTES gone     the same, and the cable is pulled
//   printer:  at NOW BYTES idle     the same, and nothing will happen until the host does something
//
// NOW is UNTIL, or earlier if there is something for the host to read. The host sets its clock to NOW,
// reads those bytes, does everything that is due, and waits again. It opens the terminal before its first
// `wait`, which counts as the opening of the line; closing the socket counts as hanging up.
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
  /// Calls `ready` with the terminal's path as soon as a host can open terminal and socket. Throws
  /// std::system_error if the socket cannot be made. Precondition: options.control has a value.
  Lockstep(const SimulatorOptions& options, Printer& printer, std::function<void(const std::string&)> ready);
  ~Lockstep();
  Lockstep(const Lockstep&) = delete;
  Lockstep& operator=(const Lockstep&) = delete;

  /// Runs until a signal arrives or, with options.once, until the host hangs up.
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
  std::string pending_;                 ///< The beginning of an incomplete message.
  std::uint64_t heard_ = 0, told_ = 0;  ///< Bytes received from the host and handed to it.
  bool dtr_low_ = true, used_ = false, stopped_ = false;
};

}  // namespace unicursal::sim
