// What Repetier 1.0.4 does unlike Marlin (firmware facts): it says ok when a line is received; it repeats its
// requests for a line; repeated lines are skipped with a word; the mixture is the extruder's present one, not
// the move's, so a change acts on the moves that run; and it tells when it is idle.
// Departures: the lines that it swallows while it waits for a resend are not limited in number; M112 has the
// same boot as power-up.
#pragma once

#include <memory>

#include "sim/firmware/firmware.hpp"

namespace unicursal::sim {

class Repetier final : public Firmware {
 public:
  static constexpr std::size_t tools = 16;

  Repetier(const Machine& machine, const Personality& personality, MoveSink& sink, Reply reply);

  void die(const std::string& reason) override;

 private:
  void repeated(std::int64_t number) override;
  void refuse(LineVerdict::Kind kind) override;
  bool handled_at_once(std::string_view line) override;
  void taken(const Line& line) override;
  void done(const Line& line) override;
  void say_busy() override { say("busy:processing"); }
  void say_heating(const HeatWait&) override { say(temperatures()); }
  void say_unknown(const std::string& body) override;
  void say_refused(const char*) override {}
  bool knows(const Command& command) const override;
  Mix current_mix() const override { return {selected_, live_}; }
  std::optional<double> next_habit() const override;
  void follow_habits() override;
  void forget() override;

  std::string temperatures() const override;
  void report_temperatures(const Command& command) override;
  void emergency_stop(const Command& command) override;
  void report_firmware(const Command& command) override;
  void collect_share(const Command& command) override;
  void store_mixture(const Command& command) override;
  void select_tool(const Command& command) override;

  void ask_for_line();
  void mix_live(const Factors& weights);
  Factors equal_parts() const;

  Factors live_{};
  std::array<Factors, tools> tools_{};
  int selected_ = 0;
  bool waits_for_line_ = false;  ///< that it has asked for
  double ask_at_ = 0;            ///< again
  double idle_at_ = 0;           ///< when to say that it waits
};

/// The family that the personality belongs to.
std::unique_ptr<Firmware> make_firmware(const Machine& machine, const Personality& personality,
                                        MoveSink& sink, Firmware::Reply reply);

}  // namespace unicursal::sim
