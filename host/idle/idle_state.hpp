// The internal state of an idle printer: one coroutine holds the connection and carries out the commands.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "host/engine/printer_view.hpp"
#include "host/engine/session.hpp"
#include "host/idle/idle_printer.hpp"
#include "host/link/link.hpp"
#include "host/loop/signal.hpp"

namespace unicursal::host {

struct IdlePrinter::State : std::enable_shared_from_this<State> {
  using Axes = std::array<bool, 3>;
  using Place = std::array<double, 3>;

  /// A command that waits, or is being carried out.
  struct Step {
    enum class Kind { lines, cool, home, move, feed };
    Kind kind = Kind::lines;
    std::vector<std::string> lines;
    Axes axes{};        ///< to be homed
    std::string doing;  ///< a sentence; may be empty
    std::optional<Feeding> feeding;
  };
  enum class Leave { no, close, hand_over };

  State(asio::any_io_executor on, asio::any_io_executor elsewhere, std::shared_ptr<Clock> by)
      : executor(on), opener(std::move(elsewhere)), clock(std::move(by)), wake(std::move(on), clock) {}
  ~State();

  // The connection (idle_connection.cpp). `self` keeps the state alive meanwhile.
  asio::awaitable<void> run(std::shared_ptr<State> self);
  asio::awaitable<void> hold();
  asio::awaitable<void> open();
  asio::awaitable<void> converse();
  asio::awaitable<void> greet();
  asio::awaitable<void> watch(std::shared_ptr<State> self, std::uint64_t of_turn);
  asio::awaitable<bool> come_back();
  asio::awaitable<void> say_farewell();
  void warn_of_heat();
  void look_for_it();
  bool note_failure(const std::string& sentence);
  void end();
  void hear(const std::string& line);
  void quote(const std::string& line);
  void note_firmware();

  // Carrying out (idle_steps.cpp)
  asio::awaitable<void> perform(Step step);
  asio::awaitable<void> send(std::vector<std::string> lines);
  asio::awaitable<void> ask_place();
  asio::awaitable<void> feed(const Feeding& made);
  void note_feeding(const StreamResult& result);
  bool must_cool() const { return hot() && clock->now() >= last_command + patience; }
  TimePoint next_look() const;
  std::vector<std::string> cold_lines() const;

  // Commands
  void check_open() const;
  void accept(Step step);
  void clear_steps(Ending of_feeding);
  void ask_to_leave(Leave how);
  void begin(const std::shared_ptr<State>& self);
  bool leave_connection(const std::shared_ptr<State>& self, Leave how);
  void forget_slack_axes();
  bool hot() const;
  /// It is to be left, and must be cooled first: the bed is hot after filament was moved, or the printer was
  /// lost while it was hot.
  bool leaves_hot() const { return (leave == Leave::close && hot()) || (leave != Leave::no && cools_first); }
  bool homed() const { return known_axes == Axes{true, true, true}; }
  bool feeds() const;
  std::string doing() const;
  IdleStatus::Action action() const;
  void changed();

  const asio::any_io_executor executor, opener;
  const std::shared_ptr<Clock> clock;
  Signal wake;
  std::function<void()> observer;
  std::function<void(const std::string&)> listener;
  std::string quoted;  ///< the last line that the listener has got

  Profile profile;
  std::string port;          ///< as it was asked for
  std::string same_port;     ///< a name of the adapter that stays; empty: it has none
  int descriptor = -1;       ///< an open port that no link has yet
  bool boots = true;         ///< opening the port may have reset the board
  bool running = false;      ///< the coroutine is
  bool returning = false;    ///< it waits for a cable to be plugged in
  TimePoint wait_until{};    ///< as long as it is looked for
  bool may_be_hot = false;   ///< as IdlePrinter::may_be_hot()
  bool cools_first = false;  ///< the next conversation begins with that, since it may be hot
  Leave leave = Leave::no;
  int handed_over = -1;
  IdleStatus::Connection connection = IdleStatus::Connection::closed;
  std::optional<Link> link;
  std::optional<Session> session;  ///< while filament moves
  std::uint64_t turn = 0;          ///< counts the links
  std::optional<std::string> failure;
  std::string problem, firmware;
  std::optional<Ending> fed;  ///< as IdleStatus::fed
  bool restarted = false;     ///< the board has said so during this conversation
  bool stopped = false;       ///< by stop_at_once(), or by the firmware itself

  std::deque<Step> steps;
  std::optional<Step> current;
  PrinterView view;
  double nozzle = 0, bed = 0;  ///< targets that were ordered
  TimePoint last_command{};
  TimePoint last_heard{};   ///< temperatures
  TimePoint last_motion{};  ///< of an axis; the motors let go some time later
  Axes known_axes{};
  std::optional<Place> place;        ///< behind all commands
  std::optional<Place> heard_place;  ///< the last answer to M114
};

}  // namespace unicursal::host
