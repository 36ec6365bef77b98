// Repetier 1.0.4, as far as it differs from Marlin (sim/README.md, "Repetier"): it says ok when a line is
// received; it repeats its requests for a line; it answers repeated lines with `skip`; the mixture belongs to
// the extruder and not to a move, so a change affects moves that already run; and it reports that it is idle.
// Departures: it discards any number of lines while it waits for a resend; M112 boots as at power-up; a
// binary packet is never right, since the host sends none, and damage makes none.
#pragma once

#include <memory>
#include <string>

#include "sim/firmware/firmware.hpp"

namespace unicursal::sim {

class Repetier final : public Firmware {
 public:
  static constexpr std::size_t tools = 16;

  Repetier(const Machine& machine, const Personality& personality, MoveSink& sink, Reply reply);

  void die(const std::string& reason) override;
  void alarm(Heater::Alarm what, bool bed) override;

 private:
  void repeated(std::int64_t number) override;
  void refuse(LineVerdict::Kind kind) override;
  bool swallows(char byte) override;
  void threw_line_away() override;
  bool handled_at_once(std::string_view line) override;
  void taken(const Line& line) override;
  void done(const Line& line) override;
  void say_busy() override { say("busy:processing"); }
  void say_heating(const HeatWait&) override { say(temperatures()); }
  void execute(const std::string& body) override;
  void say_unknown(const std::string& body) override;
  void go_on(const Command&) override { stopped_ = false; }
  void say_refused(const char*) override {}
  void say_stopped() override { say("Error:Printer set into dry run mode until restart!"); }
  void say_still_stopped() override {}
  bool knows(const Command& command) const override;
  Mix current_mix() const override { return {selected_, live_}; }
  std::optional<double> next_habit() const override;
  void follow_habits() override;
  void forget() override;

  std::string temperatures() const override;
  void nozzle_target(const Command& command) override;
  void wait_nozzle(const Command& command) override;
  void bed_target(const Command& command) override;
  void wait_bed(const Command& command) override;
  void feed_percent(const Command& command) override;
  void flow_percent(const Command& command) override;
  void fan(const Command& command) override;
  void report_position(const Command& command) override;
  void report_temperatures(const Command& command) override;
  void emergency_stop(const Command& command) override;
  void report_firmware(const Command& command) override;
  void collect_share(const Command& command) override;
  void store_mixture(const Command& command) override;
  void select_tool(const Command& command) override;

  bool misses_a_line() const;
  void ask_for_line();
  void mix_live(const Factors& weights);
  Factors equal_parts() const;

  Factors live_{};
  std::array<Factors, tools> tools_{};
  int selected_ = 0;
  std::string packet_;           ///< The bytes of a binary packet that have come.
  bool waits_for_line_ = false;  ///< Whether it has asked for a line.
  double ask_at_ = 0;            ///< Time of the next request.
  double idle_at_ = 0;           ///< Time of the next "wait".
};

/// Makes a firmware of the personality's family.
std::unique_ptr<Firmware> make_firmware(const Machine& machine, const Personality& personality,
                                        MoveSink& sink, Firmware::Reply reply);

}  // namespace unicursal::sim
