// One print on one printer, from the first word on the line to cold heaters, steered while it runs. It lives
// on an Asio loop that somebody else runs: the foreground command (stream.hpp) or the daemon.
//
//   PlannedSource source(lookahead, run);
//   Session session(loop.get_executor(), open_port(path, baud), source);
//   session.on_event([&](const SessionEvent& event) { tell(to_json(event)); });
//   asio::co_spawn(loop, session.run(), [](std::exception_ptr, StreamResult result) { … });
//   session.pause("somebody at the door");          // any time, on the loop's thread
//
// Everything here belongs to the loop's thread. A command returns at once; what comes of it is told by events
// and status(). s, °C, per cent.
//
// A pause ends a segment: what the printer has taken is finished, the filament is drawn back in equal shares,
// the nozzle rises and goes aside (firmware_gcode/toolpath/pause.hpp). Going on, the next line follows: none
// is lost, none is run twice. A cancelled print is parked and cooled. When the firmware asks for one of these
// by `//action:`, it is done as if the user had asked. M85 is kept fresh during a pause, so that the firmware
// cools the printer when this program dies then. A nozzle that has had nothing to do for some seconds,
// because the disk is full or planning has fallen behind, is taken aside like that as well, until it can go
// on.
#pragma once

#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware_gcode/reply/reply.hpp"
#include "host/engine/source.hpp"
#include "host/job/profile.hpp"
#include "host/link/link.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

/// Something went wrong when the printer may have been hot; it has been cooled if it still listens.
class PrintError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The printer is not the one that the print was made for; nothing was heated or moved. The message has the
/// remedy.
class PrinterUnfit : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Ending {
  completed,
  stopped,  ///< by the user; the rest was not sent, the printer was cooled
  failed
};

/// The printer cannot simply go on with the next line; nothing was sent.
struct Lost {
  std::string why;                     ///< a clause: "it has started anew"
  std::optional<std::uint64_t> place;  ///< in the leg, if the printer has told up to where it has come
};

struct StreamResult {
  Ending ending = Ending::completed;
  std::string reason;   ///< why it failed, a sentence
  bool parked = false;  ///< the nozzle was moved away at the end
  LinkStatistics statistics;
  std::string firmware;  ///< as it names itself
  double waited = 0;     ///< s that the print has waited for a layer to be planned
  std::optional<Lost> lost;
  std::size_t pauses = 0;  ///< times that it was held
  bool unfit = false;      ///< it has failed since the printer is another one; nothing was heated or moved
  bool begun = false;      ///< lines of it were sent; otherwise no spool keeps it
};

/// A print that goes on.
struct Continuation {
  std::optional<Leg> leg;  ///< to begin; absent: the printer is alive, and the last leg goes on
  /// Brings the source's run to where the spool ends, meanwhile, in a thread of its own.
  std::function<void()> catch_up;
};

/// What becomes of the nozzle's heat during a pause. The bed stays warm, or the part would come off.
enum class PauseHeat {
  keep,  ///< for a quarter of an hour
  lower  ///< so far that nothing drips or chars; it is heated again before the print goes on
};

struct StreamSettings {
  std::shared_ptr<Clock> clock = real_clock();
  Spool* spool = nullptr;         ///< that keeps the print, if one does; not if it never began
  std::filesystem::path profile;  ///< to be named where it has to be corrected; may be empty
  LinkOptions link = {};          ///< on the clock above
  /// With a spool that holds the first layers already; the source begins behind them.
  std::optional<Continuation> continuation;
  PauseHeat pause_heat = PauseHeat::keep;
  /// s after which a pause ends by itself: for where nobody is there to end it.
  std::optional<double> longest_pause;
};

enum class SessionState {
  connecting,
  heating,
  printing,
  pausing,     ///< the printer finishes what it has, and parks
  paused,      ///< until resume() or cancel()
  resuming,    ///< reheats, primes, returns
  finishing,   ///< after the last layer: parks and cools
  cancelling,  ///< before its end
  done,
  stopped,  ///< by the user
  failed
};

/// "printing"; the word that events and reports use.
const char* name(SessionState state);

constexpr bool has_ended(SessionState state) {
  return state == SessionState::done || state == SessionState::stopped || state == SessionState::failed;
}

/// A snapshot of a session.
struct SessionStatus {
  SessionState state = SessionState::connecting;
  std::string reason;                ///< of a pause or an end, a sentence; empty where there is none to tell
  std::size_t layer = 0;             ///< that is being sent, counted from 1; 0 before the first
  std::size_t layers = 0;            ///< to be printed
  double layer_fraction = 0;         ///< of the lines at hand, that were sent
  double percent = 0;                ///< of the printing time, as far as it can be foretold
  double elapsed = 0;                ///< s since the session began
  std::optional<double> left;        ///< s of printing, by the time model; absent before the first layer
  gcode::Temperatures temperatures;  ///< as last told
  std::string mixture;               ///< its name, or its shares; empty before the first
  double lookahead = 0;              ///< s of printing that are planned and not yet sent
  std::size_t lookahead_layers = 0;  ///< planned and waiting
  std::optional<double> queue;       ///< of the printer's planned moves, 0…1 full, where it tells
  double speed_percent = 100, flow_percent = 100;
  std::vector<std::string> warnings;  ///< one sentence each
};

struct SessionEvent {
  enum class Kind {
    state,     ///< the state has changed
    progress,  ///< a few lines were sent
    heat,      ///< the printer has told temperatures
    notice,    ///< the session has something to say: `text`, a sentence
    printer    ///< the printer has: `text`, made safe to show
  };
  Kind kind = Kind::state;
  std::string text;
};

const char* name(SessionEvent::Kind kind);

/// For a look-ahead that plans by the real clock of a session.
Pace pace_by(std::shared_ptr<Clock> clock);
/// The same, with the time that the printing leaves.
LookaheadOptions paced(LookaheadOptions options, const std::shared_ptr<Clock>& clock);

/// How the printer of a profile is talked to. `log`: of the serial line.
LinkOptions link_options(const Profile& profile, const std::optional<std::filesystem::path>& log);

/// Why a command is not obeyed, a sentence; nothing when it is.
using Refusal = std::optional<std::string>;

class Session {
 public:
  /// Takes over the descriptor. What it refers to must outlive it.
  Session(asio::any_io_executor executor, int port, Source& source, StreamSettings settings = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The whole print; ends when every line is acknowledged. Once. Throws nothing: whatever goes wrong is told
  /// in the result, since a report is due then as well. When the spool's disk is full, the print waits.
  asio::awaitable<StreamResult> run();

  Refusal pause(const std::string& reason = "the user has paused it");
  Refusal resume();
  /// Parks and cools. While it heats, the heating ends at once.
  Refusal cancel(const std::string& reason = "the user has stopped it");
  /// M112, past every queue; then the board's reset line, if it does not confirm. Nothing is parked.
  Refusal emergency_stop();
  /// Of the speed that the print asks for, 10…300 %.
  Refusal set_speed(double percent);
  /// Of the plastic that the print asks for, 50…200 %.
  Refusal set_flow(double percent);
  /// °C, from 0 (off) up to what is sane; the print's own changes of temperature still come.
  Refusal set_nozzle(double temperature);
  Refusal set_bed(double temperature);

  SessionStatus status() const;
  /// Called after every change; keep it short. An observer may ask for status() and give commands.
  void on_event(std::function<void(const SessionEvent&)> observer);
  /// What can be said when the loop itself has failed.
  StreamResult failed(std::exception_ptr error);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::host
