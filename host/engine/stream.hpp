// From planned layers to a printer: one event loop with the link, the look-ahead and the signals.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/engine/run.hpp"
#include "host/link/link.hpp"
#include "host/lookahead/lookahead.hpp"
#include "host/spool/chunk_reader.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

/// Something went wrong when the printer may have been hot; it has been cooled if it still listens.
class PrintError : public std::runtime_error {
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
};

/// A print that goes on.
struct Continuation {
  std::optional<Leg> leg;  ///< to begin; absent: the printer is alive, and the last leg goes on
  /// Brings `run` to where the spool ends, meanwhile, in a thread of its own.
  std::function<void()> catch_up;
};

struct StreamSettings {
  std::shared_ptr<Clock> clock = real_clock();
  double charge = 0;       ///< s of the clock that each second of planning is to take
  Spool* spool = nullptr;  ///< that keeps the print, if one does
  /// With a spool that holds the first layers already; `lookahead` begins behind them.
  std::optional<Continuation> continuation;
};

struct StreamListeners {
  std::function<void(std::size_t layers, double fraction)>
      progress;                                     ///< layers begun, part of the present one sent
  std::function<void(const std::string&)> message;  ///< what the printer says, and what happens
};

/// A print that needs no planning any more.
struct FinishedPrint {
  gcode::Chunk start;              ///< heats; what is sent first
  std::vector<gcode::Chunk> body;  ///< in order
  gcode::Chunk finish;             ///< parks and cools, wherever the printer has stopped in what was sent
};

/// Sends a whole print to the port, whose descriptor it takes over; blocks until every line is acknowledged.
/// SIGINT or SIGTERM once parks and cools, twice stops at once. SIGHUP, which a closed terminal may send
/// twice, counts as one of them at most, and not at all where it is ignored (nohup). Whatever goes wrong is
/// told in the result, since a report is due then as well. When the spool's disk is full, the print waits.
StreamResult stream(int port, Lookahead& lookahead, Run& run, const StreamListeners& listeners,
                    const StreamSettings& settings = {});
/// The same; progress counts chunks of the body instead of layers.
StreamResult stream(int port, const FinishedPrint& print, const StreamListeners& listeners,
                    const StreamSettings& settings = {});

}  // namespace unicursal::host
