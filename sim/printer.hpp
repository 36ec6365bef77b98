// The printer as one machine: cable, faults and firmware, without any input or output of this computer. It
// has no clock of its own; whoever holds it says how far printer time goes. Printer seconds since power-up.
//
//   Printer printer(machine, personality("marlin"), {250000, Usb::cdc}, faults, bed);
//   printer.opened();
//   printer.write("G28\n");
//   printer.advance(60);                    // returns as soon as something has reached the computer
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

  /// A computer opens the line: the first time power comes on, later a board with its reset on DTR resets if
  /// `dtr_rises`.
  void opened(bool dtr_rises = true);
  /// The computer sends.
  void write(std::string_view bytes);
  /// Lets time run until then, or until something has reached the computer, or the cable is just pulled.
  /// False: so many steps have been taken, and there is more to come.
  bool advance(double until, std::uint64_t most_steps = std::numeric_limits<std::uint64_t>::max());
  /// When the next thing happens by itself.
  std::optional<double> next_event() const;
  double now() const { return now_; }
  /// What has reached the computer and was not taken yet.
  std::string take_output() { return std::exchange(output_, {}); }
  bool has_output() const { return !output_.empty(); }
  /// Something is under way that ends by itself: bytes, a boot, a command that waits.
  bool busy() const;

  /// The cable is out.
  bool unplugged() const { return plug_at_.has_value(); }
  /// When it comes back; infinite if never. Precondition: unplugged().
  double plug_time() const { return *plug_at_; }
  void plug_in() { plug_at_.reset(); }

  /// Nobody listens any more: what is on its way arrives, what was received is done.
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
