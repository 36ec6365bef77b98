// A printer's firmware: bytes in, lines of replies out, moves to a sink. It behaves like Marlin 2.1.2 on a
// 32-bit board with a mixing extruder (firmware facts). It has no clock of its own: whoever holds it says how
// far printer time goes, so it can run in real time, in leaps, or step by step in a test.
//
//   Firmware printer(machine, bed, [](std::string_view line) { … });
//   printer.boot();
//   printer.receive("G28\n");                                 // answers what needs no time
//   while (printer.blocked()) printer.advance(*printer.next_event());
//
// Order of things, as on the board: bytes wait in the receive buffer; lines are checked and queued as long as
// fewer than four commands are (the running one counts); commands run one at a time; a move is answered when
// it is planned, most others when they are done. Units: mm, mm/s, °C, printer seconds since power-up.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "sim/firmware/coordinates.hpp"
#include "sim/firmware/heater.hpp"
#include "sim/firmware/mixer.hpp"
#include "sim/line/line_assembler.hpp"
#include "sim/line/line_check.hpp"
#include "sim/line/receive_buffer.hpp"
#include "sim/line/words.hpp"
#include "sim/motion/planner.hpp"

namespace unicursal::sim {

struct Machine {
  std::array<double, 3> bed{200, 200, 200};  ///< mm
  MotionLimits limits;
  std::size_t feeders = 3;
  HeaterModel nozzle{425, 120, 260};
  HeaterModel bed_heater{175, 300, 140};
};

struct LineCounts {
  std::uint64_t received = 0;         ///< complete lines that were not blank
  std::uint64_t accepted = 0;         ///< numbered lines taken
  std::uint64_t executed = 0;         ///< commands done, numbered or not
  std::uint64_t checksum_errors = 0;  ///< a wrong one, or none beside a number
  std::uint64_t number_errors = 0;
  std::uint64_t resends = 0;
  std::uint64_t repeated = 0;  ///< dropped in silence
  std::uint64_t unknown = 0;
  bool executed_in_order = true;  ///< every numbered line once, each one more than the one before
};

class Firmware {
 public:
  static constexpr std::size_t queue_size = 4;  ///< commands, the running one included

  /// Takes one line of reply, without its newline.
  using Reply = std::function<void(std::string_view line)>;

  Firmware(const Machine& machine, MoveSink& sink, Reply reply);

  /// What a board says after power-up.
  void boot();
  /// Bytes arrive now.
  void receive(std::string_view bytes);
  /// Lets printer time run; everything due until then happens, in order.
  void advance(double until);
  double now() const { return now_; }
  /// When the next thing happens by itself; nothing when the printer rests or is dead.
  std::optional<double> next_event() const;
  /// The running command waits for time to pass.
  bool blocked() const { return running_ && !dead(); }
  /// Lets time run until every command received has been done and all is still.
  void run_down();

  bool killed() const { return killed_; }
  bool hung() const { return planner_.stuck(); }

  const LineCounts& counts() const { return counts_; }
  const ReceiveBuffer& buffer() const { return buffer_; }
  const LineAssembler& assembler() const { return assembler_; }
  std::int64_t last_line() const { return check_.last(); }
  const Planner& planner() const { return planner_; }
  const Coordinates& coordinates() const { return coordinates_; }
  const Heater& nozzle() const { return nozzle_; }
  const Heater& bed() const { return bed_; }
  /// What a user should know about, and how often it happened.
  const std::map<std::string, std::uint64_t>& warnings() const { return warnings_; }

 private:
  struct Line {
    std::optional<std::int64_t> number;
    std::string body;
  };
  /// Something that the running command waits for, and what it does then.
  struct Wait {
    enum class For { room, stillness, time } what;
    double until = 0;               ///< printer time
    std::function<void()> then;     ///< may add waits
    std::optional<double> settled;  ///< a heater's wait: when it is hot and only has to stay so
  };
  using Handler = void (Firmware::*)(const Command&);

  // firmware.cpp: lines in, commands one at a time, time
  void settle();
  void read_lines();
  void take(const std::string& line);
  void refuse(LineVerdict::Kind kind);
  bool handled_at_once(std::string_view line);
  void start_next();
  bool progress();
  bool over(const Wait& wait) const;
  void finish();
  void note_order(const Line& line);
  void tick();
  bool dead() const { return killed_ || planner_.stuck(); }
  void kill();
  void quick_stop();
  void warn(const std::string& what) { ++warnings_[what]; }
  void wait_for_room(std::function<void()> then);
  void wait_until_still(std::function<void()> then);
  void wait_seconds(double seconds, std::function<void()> then);
  void wait_for_heater(Heater& heater, bool heating_only);

  // commands.cpp: what each command does
  static const std::map<std::pair<char, int>, Handler>& handlers();
  void execute(const std::string& body);
  bool extruder_exists(const Command& command);
  std::string temperatures() const;
  void nothing(const Command&) {}
  void move(const Command& command);
  void dwell(const Command& command);
  void inches(const Command& command);
  void home(const Command& command);
  void absolute(const Command& command);
  void set_origin(const Command& command);
  void extruder_mode(const Command& command);
  void motors_off(const Command& command);
  void set_inactivity(const Command& command);
  void steps_per_mm(const Command& command);
  void nozzle_target(const Command& command);
  void report_temperatures(const Command& command);
  void wait_nozzle(const Command& command);
  void line_number(const Command& command);
  void emergency_stop(const Command& command);
  void report_position(const Command& command);
  void report_firmware(const Command& command);
  void bed_target(const Command& command);
  void auto_report(const Command& command);
  void collect_share(const Command& command);
  void store_mixture(const Command& command);
  void wait_bed(const Command& command);
  void accelerations(const Command& command);
  void max_speeds(const Command& command);
  void set_accelerations(const Command& command);
  void jerks(const Command& command);
  void feed_percent(const Command& command);
  void flow_percent(const Command& command);
  void finish_moves(const Command& command);
  void stop_moves(const Command& command);
  void select_tool(const Command& command);
  void plan(const MoveTarget& target, double e);
  double filament_to_feed(double e);
  void homed(bool x, bool y, bool z);
  void say_position();

  Machine machine_;
  Reply reply_;
  ReceiveBuffer buffer_;
  LineAssembler assembler_;
  LineCheck check_;
  LineCounts counts_;
  std::deque<Line> queue_;
  std::deque<Wait> waits_;
  Planner planner_;
  Coordinates coordinates_;
  Mixer mixer_;
  Heater nozzle_, bed_;
  std::map<std::string, std::uint64_t> warnings_;

  double now_ = 0;
  double filament_ = 0;  ///< mm asked of the feeders since power-up
  bool running_ = false, answers_ok_ = true, killed_ = false;
  std::int64_t last_executed_ = 0;  ///< line number
  double busy_at_ = 0;              ///< when to say that a command still runs
  double heat_report_at_ = 0;
  double report_interval_ = 0, report_at_ = 0;  ///< M155; 0: off
  double inactivity_ = 0;                       ///< M85, s; 0: off
  double active_at_ = 0;                        ///< last command or motion
};

}  // namespace unicursal::sim
