// The printer as one machine: cable, faults and firmware, without any input or output of this computer. It
// has no clock of its own; its owner decides how far printer time advances. Times are printer seconds since
// power-up.
//
//   Printer printer(machine, personality("marlin"), {250000, Usb::cdc}, faults, bed);
//   printer.opened();
//   printer.write("G28\n");
//   printer.advance(60);                    // returns early if something has reached the computer
//   use(printer.take_output());
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sim/faults/faults.hpp"
#include "sim/firmware/repetier.hpp"
#include "sim/line/wire.hpp"

namespace unicursal::sim {

class Printer {
 public:
  Printer(const Machine& machine, const Personality& personality, const WireModel& wire,
          const FaultPlan& faults, MoveSink& sink);

  /// The computer opens the line. The first time, power comes on; later, a board whose reset hangs on DTR
  /// resets if `dtr_rises`.
  void opened(bool dtr_rises = true);
  /// The computer sends `bytes`.
  void write(std::string_view bytes);
  /// Advances time to `until`. Stops earlier if something has reached the computer or the cable has just been
  /// pulled. Returns false if `most_steps` events were processed and more are due.
  bool advance(double until, std::uint64_t most_steps = std::numeric_limits<std::uint64_t>::max());
  /// The time of the next event that happens by itself; nullopt if none will.
  std::optional<double> next_event() const;
  double now() const { return now_; }
  /// Returns the bytes that have reached the computer since the last call.
  std::string take_output() { return std::exchange(output_, {}); }
  bool has_output() const { return !output_.empty(); }
  /// Whether something is in progress that ends by itself: bytes on the cable, a boot, a waiting command.
  bool busy() const;

  /// Whether the cable is pulled.
  bool unplugged() const { return plug_at_.has_value(); }
  /// The time at which the cable is plugged in again; infinity = never. Precondition: unplugged().
  double plug_time() const { return *plug_at_; }
  void plug_in() { plug_at_.reset(); }

  /// The host is gone: lets the bytes on the cable arrive and executes everything that was received.
  void run_down();

  const Firmware& firmware() const { return *firmware_; }
  void watch_commands(Firmware::CommandWatch watch) { firmware_->watch_commands(std::move(watch)); }
  const Faults& faults() const { return faults_; }

 private:
  void step(double time);
  void receive(double until);
  void say(std::string_view line);
  void strike(const Fault& fault);
  void deliver();

  Wire wire_;
  Faults faults_;
  std::unique_ptr<Firmware> firmware_;
  std::string output_;
  double now_ = 0;
  bool powered_ = false;
  std::optional<double> plug_at_;
};

}  // namespace unicursal::sim
