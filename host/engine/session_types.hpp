// The words of a session: its settings, states, events and results. s, °C, per cent.
#pragma once

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
#include "host/link/link.hpp"
#include "host/loop/clock.hpp"
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

/// Why a command is not obeyed, a sentence; nothing when it is.
using Refusal = std::optional<std::string>;

}  // namespace unicursal::host
