// RepRapFirmware 3.5 on a Duet, over native USB, as far as it differs from Marlin (sim/README.md,
// "RepRapFirmware"): a line is read when the one before is done; line numbers are not checked, a checksum may
// be absent, and a line with a wrong one is dropped without a word; a line may hold several commands; one
// tool has several drives, whose shares multiply E and travel with each move; nothing moves that is not
// homed; a heater that fails is switched off, and the rest goes on without plastic; an emergency stop lasts
// until M999.
//
// Departures: the tool exists from power-up, as config.g defines it, and M563 is not known; its macros are
// empty; the receive buffer is that of the other boards, without the flow control of USB; after M999 the port
// stays; the queue of moves is as short as Marlin's.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/firmware/firmware.hpp"

namespace unicursal::sim {

class RepRapFirmware final : public Firmware {
 public:
  RepRapFirmware(const Machine& machine, const Personality& personality, MoveSink& sink, Reply reply);

  void die(const std::string& reason) override;
  void alarm(Heater::Alarm what, bool of_bed) override;

 private:
  using Own = void (RepRapFirmware::*)(const Command&);
  static const std::map<std::pair<char, int>, Own>& own_handlers();

  // Lines
  std::vector<std::string> commands_in(const std::string& body) const override;
  void refuse(LineVerdict::Kind kind) override;
  bool handled_at_once(std::string_view) override { return false; }
  void done(const Line& line) override;
  void say_busy() override {}
  void say_heating(const HeatWait&) override {}
  void say_stopped() override;
  std::optional<double> next_habit() const override;
  void follow_habits() override;
  void forget() override;

  // Commands
  void execute(const std::string& body) override;
  void fail(const Command& command, std::string_view why);
  void not_supported(const Command& command);
  void travel(const Command& command);
  void home_axes(const Command& command);
  void set_place(const Command& command);
  void axes_mode(const Command& command);
  void filament_mode(const Command& command);
  void let_go(const Command& command);
  void heat_tool(const Command& command);
  void heat_tool_and_wait(const Command& command);
  void heat_bed_and_wait(const Command& command);
  void tell_temperatures(const Command& command);
  void tell_place(const Command& command);
  void tell_name(const Command& command);
  void fan(const Command&) {}
  void halt_at_once(const Command& command);
  void restart(const Command& command);
  void flow_factor(const Command& command);
  void steps(const Command& command);
  void speeds(const Command& command);
  void accelerations_of_axes(const Command& command);
  void jumps(const Command& command);
  void pause_of_file(const Command& command);
  void clear_faults(const Command& command);
  void mix(const Command& command);
  void change_tool(const std::string& text);

  bool addresses_tool(const Command& command, char letter);
  void set_nozzle(double target);
  std::string per_axis(const PerAxis<double>& values, double scale, int decimals) const;
  std::string temperatures() const override;
  double residency() const override { return 0; }
  double filament_to_feed(double e) override;
  Mix current_mix() const override;
  void warn_rarely(std::string text);
  void halt();

  std::string text_;               ///< The command that runs, in upper case.
  bool selected_ = false;          ///< Whether the tool is in use.
  std::vector<double> shares_;     ///< Of the tool's drives; they multiply E.
  std::array<bool, 3> homed_{};    ///< x y z
  bool absolute_filament_ = true;  ///< M82
  bool moves_axes_ = false;        ///< Whether the running move has x, y or z.
  bool tool_fault_ = false, bed_fault_ = false;
  bool asked_for_heat_ = false;  ///< Whether M105 has come: from then on it reports during long commands.
  double report_due_ = 0;
  std::optional<std::string> warning_;  ///< To be shown when the last one is old enough.
  double warning_due_ = 0;
};

}  // namespace unicursal::sim
