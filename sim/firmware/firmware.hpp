// A printer's firmware: bytes in, lines of replies out, moves to a sink. It behaves like Marlin 2.1.2 with a
// mixing extruder (sim/README.md, "Marlin 2.1"); other families override the functions in which they differ.
// It has no clock of its own: its owner decides how far printer time advances, so it can run in real time, in
// leaps, or step by step in a test.
//
//   Firmware printer(machine, personality("marlin"), bed, [](std::string_view line) { … });
//   printer.receive("G28\n");                                 // executes what needs no time
//   while (printer.blocked()) printer.advance(*printer.next_event());
//
// The order of events is that of the board: bytes wait in the receive buffer; lines are checked and queued
// while fewer than four commands are queued (the running one counts); commands run one at a time; a move is
// answered when it is planned, most other commands when they are done. Units: mm, mm/s, °C, printer seconds
// since power-up.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/firmware/coordinates.hpp"
#include "sim/firmware/heater.hpp"
#include "sim/firmware/mixer.hpp"
#include "sim/firmware/personality.hpp"
#include "sim/firmware/screen.hpp"
#include "sim/line/line_assembler.hpp"
#include "sim/line/line_check.hpp"
#include "sim/line/receive_buffer.hpp"
#include "sim/line/wire.hpp"
#include "sim/line/words.hpp"
#include "sim/motion/planner.hpp"

namespace unicursal::sim {

struct Machine {
  std::array<double, 3> bed{200, 200, 200};  ///< Bed size, mm.
  std::array<double, 2> overtravel{};        ///< How far the software endstops let x and y go below 0, mm.
  MotionLimits limits;
  std::size_t feeders = 3;
  HeaterModel nozzle;
  HeaterModel bed_heater = HeaterModel::bed();
};

struct LineCounts {
  std::uint64_t received = 0;         ///< Complete lines that were not blank.
  std::uint64_t accepted = 0;         ///< Numbered lines that were accepted.
  std::uint64_t executed = 0;         ///< Executed commands, numbered or not.
  std::uint64_t checksum_errors = 0;  ///< Numbered lines with a wrong checksum or without one.
  std::uint64_t number_errors = 0;    ///< Lines with an unexpected number.
  std::uint64_t resends = 0;          ///< Requests for a line.
  std::uint64_t repeated = 0;         ///< Repeated lines that were dropped silently.
  std::uint64_t skipped = 0;          ///< Repeated lines that were answered with `skip` (Repetier).
  std::uint64_t unknown = 0;          ///< Unknown commands.
  std::uint64_t unseen_damage = 0;    ///< Damaged lines that were accepted, since the 8-bit checksum matched.
  std::uint64_t disguised = 0;        ///< Damaged lines that looked like lines without a number.
  std::uint64_t while_booting = 0;    ///< Bytes that arrived while the firmware booted.
  std::uint64_t resets = 0;           ///< Resets after power-up.
  bool executed_in_order = true;      ///< Whether each numbered line was executed once, in order.
};

class Firmware {
 public:
  /// Receives each line of the replies, without its newline.
  using Reply = std::function<void(std::string_view line)>;
  /// Sees every complete line that arrives, and returns the firmware's error with it.
  using LineWatch = std::function<Misreading(std::string_view line)>;
  /// Sees every command that is executed, without line number and checksum.
  using CommandWatch = std::function<void(const std::string& command)>;

  Firmware(const Machine& machine, const Personality& personality, MoveSink& sink, Reply reply);
  virtual ~Firmware() = default;
  Firmware(const Firmware&) = delete;
  Firmware& operator=(const Firmware&) = delete;

  /// Power comes on: the firmware boots and then says what it is. Without this call it is ready at once.
  void boot();
  /// Resets the board: motion stops where it is, heaters go off, memory is cleared, and the firmware boots.
  void reset();
  /// Receives bytes at the current time.
  void receive(const std::vector<WireByte>& bytes);
  void receive(std::string_view bytes);
  /// Advances printer time to `until`; everything that is due happens, in order.
  void advance(double until);
  double now() const { return now_; }
  /// The time of the next event that happens by itself; nullopt if the printer is idle or dead.
  std::optional<double> next_event() const;
  /// Whether the running command waits for time to pass (not for a person), or the firmware boots.
  bool blocked() const {
    return booting_ || (running_ && !dead() && !silent() && awaited_ == Awaited::nothing);
  }
  bool booting() const { return booting_; }
  /// Advances time until every received command has been executed and all motion has ended.
  void run_down();

  // Observation and faults
  void watch_lines(LineWatch watch) { watch_ = std::move(watch); }
  void watch_commands(CommandWatch watch) { command_watch_ = std::move(watch); }
  /// Neither reads nor answers for `seconds`; moves continue.
  void stall(double seconds) { stalled_until_ = now_ + seconds; }
  /// Stops for good, with `reason` as an error message.
  virtual void die(const std::string& reason);
  /// A command is given at its display, or by itself: it comes next, and nobody waits for its ok.
  void enter(std::string command);
  /// From now on it takes so long to boot, s.
  void set_boot_seconds(double seconds) { personality_.boot_seconds = seconds; }
  /// From now on a command of this word ("G29") takes `seconds` longer. Meanwhile the firmware reports probed
  /// points (`chatty`), or says nothing; it does not say that it is busy. A command that it does not know
  /// becomes known.
  void lengthen(std::string_view word, double seconds, bool chatty);
  /// A feeder runs out of filament, which a sensor that is switched on notices: the firmware announces it
  /// and gives itself the command `script`.
  void run_out(std::string script);
  /// What it does when it has noticed that a heater or its sensor has failed.
  virtual void alarm(Heater::Alarm what, bool bed);
  /// Switches its heaters off; from now on it acknowledges moves and does none, until M999 or a reset.
  void stop_moving();

  bool killed() const { return killed_; }
  bool hung() const { return planner_.stuck(); }

  const Personality& personality() const { return personality_; }
  const LineCounts& counts() const { return counts_; }
  const ReceiveBuffer& buffer() const { return buffer_; }
  const LineAssembler& assembler() const { return assembler_; }
  std::int64_t last_line() const { return check_.last(); }
  const Planner& planner() const { return planner_; }
  const Coordinates& coordinates() const { return coordinates_; }
  const PrinterScreen& screen() const { return screen_; }
  const Heater& nozzle() const { return nozzle_; }
  const Heater& bed() const { return bed_; }
  Heater& nozzle() { return nozzle_; }
  Heater& bed() { return bed_; }
  /// Events that a user should know about, and how often each happened.
  const std::map<std::string, std::uint64_t>& warnings() const { return warnings_; }

 protected:
  struct Line {
    std::optional<std::int64_t> number;
    std::string body;
    bool injected = false;  ///< The firmware gave it to itself, so nobody waits for an ok.
    bool more = false;      ///< Whether another command of the same line follows.
  };
  /// A command that takes longer than usual.
  struct LongWork {
    std::string word;
    double seconds;
    bool chatty;
  };
  /// A wait for a heater to stay at its target for a while.
  struct HeatWait {
    const Heater* heater;
    bool heating_only;
    std::optional<double> since;  ///< The time at which it reached its target.
  };
  /// A condition that the running command waits for, and the action that follows.
  struct Wait {
    enum class For { room, stillness, time, heat, person } what;
    double until = 0;            ///< Printer time; for heat the time of the next check.
    std::function<void()> then;  ///< May add further waits.
    std::optional<HeatWait> heat;
  };
  using Handler = void (Firmware::*)(const Command&);

  // The steps from line to ok in which families differ
  virtual void repeated(std::int64_t) { ++counts_.repeated; }
  virtual void refuse(LineVerdict::Kind kind);
  /// Takes a byte that does not belong to a line of text. Returns whether it was one.
  virtual bool swallows(char) { return false; }
  virtual void threw_line_away() {}
  virtual bool handled_at_once(std::string_view line);
  /// The commands that a line holds; at least one.
  virtual std::vector<std::string> commands_in(const std::string& body) const { return {body}; }
  /// Called when a line has been queued.
  virtual void taken(const Line&) {}
  /// Called when the running command is done, while it is still in the queue.
  virtual void done(const Line& line);
  virtual void say_busy();
  virtual void say_heating(const HeatWait& wait);
  virtual void say_unknown(const std::string& body);
  virtual void say_refused(const char* what);
  /// What it says when it has stopped moving, and at a move after that; the latter may be empty.
  virtual void say_stopped();
  virtual void say_still_stopped();
  virtual bool knows(const Command& command) const;
  /// Whether it knows the command and its family has an action for it.
  bool handles(const Command& command) const;
  virtual Mix current_mix() const { return mixer_.current(); }
  /// Time for which a heater must have been hot before M109 or M190 ends, s.
  virtual double residency() const { return 10; }
  /// The time at which the family next does something by itself; nullopt if it will not.
  virtual std::optional<double> next_habit() const { return std::nullopt; }
  virtual void follow_habits() {}
  /// Clears the family's own memory after a reset, and restarts the times of its habits.
  virtual void forget() {}

  // firmware.cpp: incoming lines, commands one at a time, time
  void settle();
  void read_lines();
  void take(const std::string& line, bool damaged);
  void accept(LineVerdict verdict, bool damaged);
  void start_next();
  bool progress();
  bool over(Wait& wait);
  bool hot_for_long(Wait& wait);
  void finish();
  void work_on(double seconds, bool chatty);
  void note_order(const Line& line);
  void tick();
  void tick_heaters();
  void wake_up();
  bool frozen() const { return now_ < stalled_until_; }
  /// Whether it is frozen for ever.
  bool silent() const { return stalled_until_ == std::numeric_limits<double>::infinity(); }
  bool dead() const { return killed_ || planner_.stuck(); }
  bool idle() const { return !running_ && queue_.empty(); }
  bool waits_for_heat() const { return !waits_.empty() && waits_.front().what == Wait::For::heat; }
  void kill();
  void quick_stop();
  void warn(const std::string& what) { ++warnings_[what]; }
  void say(std::string_view line) { reply_(line); }
  void wait_for_room(std::function<void()> then);
  void wait_until_still(std::function<void()> then);
  void wait_seconds(double seconds, std::function<void()> then);
  void wait_for_heater(const Heater& heater, bool heating_only);

  // commands.cpp: the commands
  static const std::map<std::pair<char, int>, Handler>& handlers();
  virtual void execute(const std::string& body);
  bool extruder_exists(const Command& command);
  virtual std::string temperatures() const;
  void nothing(const Command&) {}
  virtual void go_on(const Command& command);
  // person.cpp: waits for a person
  void show_prompt(std::string_view text, std::initializer_list<std::string_view> buttons);
  void wait_for_person(std::function<void()> then);
  void wait_for_choice(std::function<void()> then);
  void person_came();
  void answer_prompt(int button);
  void stop_for_person(const Command& command);
  void change_filament(const Command& command);
  void offer_purging();
  void look_for_emergency(char byte);

  // settings.cpp: reports of settings
  MotionLimits original_limits() const;
  std::string setting(int code) const;
  bool only_asks(const Command& command);
  virtual void report_settings(const Command& command);
  virtual void load_settings(const Command& command);
  virtual void store_settings(const Command& command);
  void keepalive(const Command& command);
  void pid(const Command& command);
  void cold_extrusion(const Command& command);
  void soft_endstops(const Command& command);
  void runout_sensor(const Command& command);
  void echo_text(const Command& command);
  void print_time(const Command& command);
  void endstops(const Command& command);

  // show.cpp: the printer's own display
  void show_text(const Command& command);
  void set_progress(const Command& command);

  void move(const Command& command);
  void arc(const Command& command);
  void run_arc(std::vector<MoveTarget> pieces);
  bool refused_unhomed(const Command& command);
  void dwell(const Command& command);
  virtual void fan(const Command&) {}
  void inches(const Command& command);
  void home(const Command& command);
  void absolute(const Command& command);
  void set_origin(const Command& command);
  void extruder_mode(const Command& command);
  void motors_off(const Command& command);
  void set_inactivity(const Command& command);
  void steps_per_mm(const Command& command);
  virtual void nozzle_target(const Command& command);
  virtual void report_temperatures(const Command& command);
  virtual void wait_nozzle(const Command& command);
  virtual void line_number(const Command& command);
  virtual void emergency_stop(const Command& command);
  virtual void report_position(const Command& command);
  virtual void report_firmware(const Command& command);
  virtual void bed_target(const Command& command);
  void auto_report(const Command& command);
  virtual void collect_share(const Command& command);
  virtual void store_mixture(const Command& command);
  void mix_directly(const Command& command);
  virtual void wait_bed(const Command& command);
  void accelerations(const Command& command);
  void max_speeds(const Command& command);
  void set_accelerations(const Command& command);
  void jerks(const Command& command);
  virtual void feed_percent(const Command& command);
  virtual void flow_percent(const Command& command);
  void finish_moves(const Command& command);
  void stop_moves(const Command& command);
  virtual void select_tool(const Command& command);
  void plan(const MoveTarget& target, double e);
  virtual double filament_to_feed(double e);
  void homed(bool x, bool y, bool z);
  void lift_for_homing();
  void say_position();

  const Machine machine_;
  Personality personality_;
  Reply reply_;
  LineWatch watch_;
  CommandWatch command_watch_;
  ReceiveBuffer buffer_;
  LineAssembler assembler_;
  LineCheck check_;
  bool line_damaged_ = false;  ///< Whether the line that is being read is damaged.
  LineCounts counts_;
  std::deque<Line> queue_;
  std::deque<Wait> waits_;
  Planner planner_;
  Coordinates coordinates_;
  Mixer mixer_;
  Heater nozzle_, bed_;
  std::map<std::string, std::uint64_t> warnings_;
  PrinterScreen screen_;

  double now_ = 0;
  double filament_ = 0;             ///< Filament that the feeders were asked for since power-up, mm.
  PerAxis<std::int64_t> origin_{};  ///< Position of the machine when the firmware last booted, steps.
  bool booting_ = false, running_ = false, answers_ok_ = true, killed_ = false;
  enum class Awaited { nothing, anything, choice } awaited_ = Awaited::nothing;
  bool purge_more_ = false;
  bool runout_sensor_ = true;  ///< M412
  bool ran_out_ = false;       ///< It waits for new filament.
  std::vector<LongWork> long_works_;
  bool at_long_work_ = false;  ///< The running command is one.
  std::string emergency_line_;
  double cold_ = 0;           ///< Below, nothing is extruded, °C.
  double busy_interval_ = 2;  ///< M113, s; 0 = off.
  bool stopped_ = false;      ///< Whether it does not move until M999.
  double boot_at_ = 0;        ///< End of the boot.
  double stalled_until_ = 0;
  std::int64_t last_executed_ = 0;  ///< Number of the last executed line.
  double busy_at_ = 0;              ///< Time of the next busy message.
  double heat_report_at_ = 0;
  double report_interval_ = 0, report_at_ = 0;  ///< M155; interval 0 = off.
  double inactivity_ = 0;                       ///< M85, s; 0 = off.
  double active_at_ = 0;                        ///< Time of the last command or motion.
};

}  // namespace unicursal::sim
