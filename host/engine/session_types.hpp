// Values of a session: its settings, states, events and results. s, °C, per cent.
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

/// Something went wrong while the printer may have been hot. It has been cooled if it still listens.
class PrintError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The printer is not the one that the print was made for; nothing was heated or moved. The message names the
/// remedy.
class PrinterUnfit : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Ending {
  completed,
  stopped,  ///< the user has stopped it; the rest was not sent, the printer was cooled
  failed
};

/// What the user, or the printer, has asked for before a session has ended.
enum class StopAsked {
  no,
  park,    ///< the print is to end, with the printer parked and cooled
  at_once  ///< an emergency stop
};

/// Why the printer cannot go on with the next line; nothing was sent.
struct Lost {
  std::string why;                     ///< a clause: "it has restarted"
  std::optional<std::uint64_t> place;  ///< the next line's place in the leg, if the printer has reported it
};

struct StreamResult {
  Ending ending = Ending::completed;
  std::string reason;   ///< why it failed, a sentence; else empty
  bool parked = false;  ///< the nozzle was moved away at the end
  LinkStatistics statistics;
  std::string firmware;  ///< the name that it reports
  double waited = 0;     ///< s that the print has waited for layers to be planned
  std::optional<Lost> lost;
  std::size_t pauses = 0;          ///< times that it was held
  bool unfit = false;              ///< the printer is not fit for this print; nothing was heated or moved
  StopAsked stop = StopAsked::no;  ///< also of one that failed
  bool begun = false;              ///< lines of it may have been sent; a print that never began is not kept
};

/// A print that goes on.
struct Continuation {
  std::optional<Leg> leg;  ///< a new leg; absent: the printer is alive, and the last leg goes on
  /// Brings the source's run to where the spool ends. It is called on a thread of its own.
  std::function<void()> catch_up;
};

/// The nozzle's heat during a pause. The bed stays warm, or the part would come off.
enum class PauseHeat {
  keep,  ///< keep it for a quarter of an hour
  lower  ///< lower it until nothing drips or chars; the nozzle is heated again before the print goes on
};

class LineFollower;

struct StreamSettings {
  std::shared_ptr<Clock> clock = real_clock();
  Spool* spool = nullptr;         ///< keeps the print; nullptr: it is not kept
  std::filesystem::path profile;  ///< its file, for messages that ask to correct it; may be empty
  LinkOptions link = {};          ///< its clock is replaced by the one above
  /// For a resumed print. Precondition: a spool that holds the first layers; the source begins behind them.
  std::optional<Continuation> continuation;
  PauseHeat pause_heat = PauseHeat::keep;
  /// Asked once, when a session in the foreground awaits signals: whether one that stops it came before.
  std::function<bool()> stop_came;
  bool display = false;              ///< the printer's own display shows how far the print is
  LineFollower* follower = nullptr;  ///< looks at the lines; it must outlive the session
  /// s after which a pause ends by itself, for prints without an operator; absent: never.
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
  cancelling,  ///< before the last layer: parks and cools
  done,
  stopped,  ///< the user has stopped it
  failed
};

/// The word that events and reports use, such as "printing".
const char* name(SessionState state);

constexpr bool has_ended(SessionState state) {
  return state == SessionState::done || state == SessionState::stopped || state == SessionState::failed;
}

/// A snapshot of a session.
struct SessionStatus {
  SessionState state = SessionState::connecting;
  std::string reason;                ///< why it is held or has ended, a sentence; may be empty
  std::size_t layer = 0;             ///< the layer that is being sent, counted from 1; 0 before the first
  std::size_t layers = 0;            ///< layers of the whole print
  double layer_fraction = 0;         ///< share of the lines at hand that were sent, 0…1
  double percent = 0;                ///< of the printing time, by the time model
  double elapsed = 0;                ///< s since the session began
  std::optional<double> left;        ///< s of printing, by the time model; absent before the first layer
  gcode::Temperatures temperatures;  ///< as last reported, °C
  std::optional<double> job_nozzle, job_bed;  ///< what the print's own lines ask for, °C; absent before them
  std::string mixture;               ///< name, or shares, of the mixture that is fed; empty before the first
  double lookahead = 0;              ///< s of printing that are planned and not yet sent
  std::size_t lookahead_layers = 0;  ///< planned and waiting
  std::optional<double> queue;       ///< fill of the printer's queue of moves, 0…1; absent if not reported
  double speed_percent = 100, flow_percent = 100;
  std::vector<std::string> warnings;  ///< one sentence each
  /// What the printer asks a person, and the answers to choose from; made safe to show.
  struct Prompt {
    std::string text;
    std::vector<std::string> answers;
  };
  std::optional<Prompt> prompt;  ///< absent unless it waits for an answer
};

struct SessionEvent {
  enum class Kind {
    state,     ///< the state has changed
    progress,  ///< a few lines were sent
    heat,      ///< the printer has reported temperatures
    notice,    ///< a message from the session: `text`, a sentence
    printer    ///< a line from the printer: `text`, made safe to show
  };
  Kind kind = Kind::state;
  std::string text;
};

const char* name(SessionEvent::Kind kind);

/// Why a command is refused, a sentence; nullopt if it is obeyed.
using Refusal = std::optional<std::string>;

}  // namespace unicursal::host
