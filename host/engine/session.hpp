// One print on one printer, from the first word on the line to cold heaters, steered while it runs. It lives
// on an Asio loop that somebody else runs: the foreground command (stream.hpp) or the daemon.
//
//   PlannedSource source(lookahead, maker);
//   Session session(loop.get_executor(), open_port(path, baud), source);
//   session.on_event([&](const SessionEvent& event) { show(to_json(event, session.status())); });
//   asio::co_spawn(loop, session.run(), [](std::exception_ptr, StreamResult result) { … });
//   session.pause("the bed is loose");              // any time, on the loop's thread
//
// Everything here belongs to the loop's thread. A command returns at once; events and status() report its
// effect. s, °C, per cent.
//
// A pause ends a segment: what the printer has taken is finished, the filament is drawn back in equal shares,
// the nozzle rises and goes aside (firmware_gcode/interruption/pause.hpp). Going on, the next line follows:
// none is lost, none is run twice. A cancelled print is parked and cooled. When the firmware asks for one of
// these by `//action:`, it is done as if the user had asked. M85 is kept fresh during a pause, so that the
// firmware cools the printer when this program dies then. A nozzle that has had nothing to do for some
// seconds, because the disk is full or planning has fallen behind, is taken aside like that as well, until it
// can go on.
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
#include "host/engine/line_follower.hpp"
#include "host/engine/session_types.hpp"
#include "host/engine/source.hpp"
#include "host/job/profile.hpp"
#include "host/link/link.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

/// For a look-ahead that plans by the real clock of a session.
PlanningClock planning_clock(std::shared_ptr<Clock> clock);
/// The same, with the time that the printing leaves.
LookaheadOptions paced(LookaheadOptions options, const std::shared_ptr<Clock>& clock);

/// How the printer of a profile is talked to. `log`: of the serial line.
LinkOptions link_options(const Profile& profile, const std::optional<std::filesystem::path>& log);

class Session {
 public:
  /// Takes over the descriptor. What it refers to must outlive it.
  Session(asio::any_io_executor executor, int port, Source& source, StreamSettings settings = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Runs the whole print, until every line is acknowledged; call it once. Never throws: the result reports
  /// what went wrong, since a report is due then as well. When the spool's disk is full, the print waits.
  asio::awaitable<StreamResult> run();

  Refusal pause(const std::string& reason = "the user has paused it");
  Refusal resume();
  /// Presses a button of the question in status().prompt, counted from 0.
  Refusal answer(std::size_t button);
  /// Parks and cools. While it heats, the heating ends at once.
  Refusal cancel(const std::string& reason = "the user has stopped it");
  /// Sends M112 past every queue, and pulses the board's reset line if the printer does not confirm. The
  /// nozzle is not parked.
  Refusal emergency_stop();
  /// Sets the speed, 10…300 % of the print's own.
  Refusal set_speed(double percent);
  /// Sets the amount of plastic, 50…200 % of the print's own.
  Refusal set_flow(double percent);
  /// Sets a temperature, °C: nozzle 0 (off) to 450, bed 0 to 200. The print's own changes still take effect.
  Refusal set_nozzle(double temperature);
  Refusal set_bed(double temperature);

  SessionStatus status() const;
  /// How far the printer is in the print's lines.
  LinePlace line_place() const;
  /// Called after every change; keep it short. An observer may ask for status() and give commands.
  void on_event(std::function<void(const SessionEvent&)> observer);
  /// Cools the printer and returns the result when the loop itself has failed.
  StreamResult failed(std::exception_ptr error);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::host
