// A printer that is connected while nothing is printed: its heat, its axes, its filament. mm, °C, s, per
// cent.
//
//   IdlePrinter idle(loop.get_executor(), opening.get_executor());
//   idle.connect(profile, "/dev/ttyUSB0");
//   idle.heat(210, 60);                             // any time once it is open, on the loop's thread
//   const int port = co_await idle.hand_over();     // a print goes on with the same port, without a reset
//
// A command returns at once, and is carried out behind those before it; status() and on_change() show its
// effect. Nobody watches an idle printer: what is hot is switched off after a quarter of an hour without a
// command, when the connection is closed, and when a printer is back whose cable was pulled. A printer that
// was lost while it was hot stays in mind (may_be_hot()): whoever gets the port next, a print too, gets it
// cold. While something is hot, M85 makes the firmware do the same when this program dies.
//
// Everything here belongs to the loop's thread; ports are opened on another.
#pragma once

#include <array>
#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "firmware_gcode/reply/reply.hpp"
#include "host/engine/session_types.hpp"
#include "host/feeding/feeding.hpp"
#include "host/job/profile.hpp"
#include "host/loop/clock.hpp"

namespace unicursal::host {

/// Why a command is not obeyed; the message is a sentence.
class IdleRefused : public std::runtime_error {
 public:
  enum class Why {
    not_now,  ///< it is not connected, or at work, or must be homed or heated first
    limit     ///< beyond what the profile allows
  };
  /// `code`: a literal for programs and for translations; null: that of `why`.
  IdleRefused(Why why, const char* code, const std::string& sentence)
      : std::runtime_error(sentence), why_(why), code_(code) {}
  Why why() const { return why_; }
  const char* code() const { return code_; }

 private:
  Why why_;
  const char* code_;
};

struct IdleStatus {
  enum class Connection { closed, connecting, open };
  enum class Action { none, feeding, heating, homing };

  Connection connection = Connection::closed;
  std::string port;                         ///< as it was asked for
  std::string firmware;                     ///< as it names itself; empty: unknown
  gcode::Temperatures temperatures;         ///< as last reported
  bool homed = false;                       ///< all three axes
  std::optional<std::array<double, 3>> at;  ///< x y z behind all commands, if it is known
  Action action = Action::none;
  std::string doing;               ///< the same, a sentence; empty: nothing
  std::optional<double> cools_in;  ///< s until it is switched off by itself; absent: it is off
  std::string problem;             ///< a sentence; empty: none
  std::optional<Ending> fed;       ///< how the last order to move filament ended; absent while it goes on
};

const char* name(IdleStatus::Connection connection);
/// Empty for none.
const char* name(IdleStatus::Action action);

class IdlePrinter {
 public:
  /// How long something stays hot without a command.
  static constexpr std::chrono::minutes patience{15};

  /// Ports are opened on `opener`, which must be another thread.
  IdlePrinter(asio::any_io_executor executor, asio::any_io_executor opener,
              std::shared_ptr<Clock> clock = real_clock());
  ~IdlePrinter();
  IdlePrinter(const IdlePrinter&) = delete;
  IdlePrinter& operator=(const IdlePrinter&) = delete;

  /// No effect on a connection that is open or being opened. `descriptor`: of the port, if the caller has it
  /// open; it is taken over. A printer that may be hot is looked for if its port is not there. Throws
  /// IdleRefused while the last one is being closed.
  void connect(const Profile& profile, const std::string& port, int descriptor = -1);
  /// Switches off what is hot, and closes the port. No effect on a closed connection.
  void disconnect();

  /// The rest throws IdleRefused. °C; 0: off. Both are obeyed, or neither.
  void heat(std::optional<double> nozzle, std::optional<double> bed);
  /// x y z; the height is found only above a place that is known.
  void home(const std::array<bool, 3>& axes);
  /// By so many mm; within the bed, or back towards it.
  void move(const std::array<double, 3>& by);
  void fan(double percent);
  /// Throws core::DataError for an order that the profile does not allow.
  void feed(const FeedingOrder& order);
  /// Pushes filament out of a hot nozzle, all feeders together in equal shares; negative: draws it back.
  void extrude(double length);
  /// Ends what is going on, and switches off what is hot.
  void cancel();
  /// M112, past every queue; the connection is closed.
  void stop_at_once();

  /// Limits and filaments of what is connected; the connection stays.
  void use(const Profile& profile);

  /// Closes the connection and returns the open port, for a print; what is hot stays hot, unless the printer
  /// was lost before: then it is reached once more if it is there, and cooled. −1 if it was not open.
  asio::awaitable<int> hand_over();
  /// As disconnect(), also for a printer that was lost while it was hot; returns when it is done, or after
  /// some seconds.
  asio::awaitable<void> close();

  IdleStatus status() const;
  /// Whether filament moves, or will.
  bool feeding() const;
  /// Whether it is open, is being opened, or waits for a cable.
  bool wanted() const;
  /// Whether something was hot when it was lost, or handed over, and nobody has seen it cold since.
  bool may_be_hot() const;
  /// To be called when a print has begun on the port that was handed over: its heat is the print's matter.
  void leave_heat_to_print();
  /// A print has lost this printer and was stopped: whoever connects to the port first switches its heaters
  /// off.
  void expect_hot(const Profile& profile, const std::string& port);
  /// Called after every change of the status.
  void on_change(std::function<void()> observer);
  /// Called with each line that the printer says, except plain answers, temperatures, and repetitions.
  void on_line(std::function<void(const std::string&)> listener);

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace unicursal::host
