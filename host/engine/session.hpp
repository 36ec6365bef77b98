// One print on one printer, from the first byte on the line to cold heaters, steered while it runs. It lives
// on an Asio loop that somebody else runs: the foreground command (stream.hpp) or the daemon.
//
//   PlannedSource source(lookahead, run);
//   Session session(loop.get_executor(), open_port(path, baud), source);
//   session.on_event([&](const SessionEvent& event) { show(event.text); });
//   asio::co_spawn(loop, session.run(), [](std::exception_ptr, StreamResult result) { … });
//   session.pause("somebody at the door");          // any time, on the loop's thread
//
// Everything here belongs to the loop's thread. A command returns at once; events and status() show its
// effect. s, °C, per cent.
//
// A paused print goes on with its next line: none is lost, none is run twice (holding.hpp). A cancelled print
// is parked and cooled. When the firmware asks for one of these by `//action:`, the session does it as if the
// user had asked. How it works inside: session_impl.hpp.
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
#include "host/engine/session_types.hpp"
#include "host/engine/source.hpp"
#include "host/job/profile.hpp"
#include "host/link/link.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

/// A planning clock for a look-ahead that plans while a session prints.
PlanningClock planning_clock(std::shared_ptr<Clock> clock);
/// Options of a look-ahead that spends as much time on planning as the printing leaves.
LookaheadOptions paced(LookaheadOptions options, const std::shared_ptr<Clock>& clock);

/// Options of the link to a profile's printer. `log`: file for every byte on the serial line.
LinkOptions link_options(const Profile& profile, const std::optional<std::filesystem::path>& log);

class Session {
 public:
  /// Takes over the descriptor `port`. The source, and what the settings refer to, must outlive the session.
  Session(asio::any_io_executor executor, int port, Source& source, StreamSettings settings = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Runs the whole print; returns when every line is acknowledged. May be called once. Does not throw: a
  /// failure is in the result, since a report is due then as well. When the spool's disk is full, it waits.
  asio::awaitable<StreamResult> run();

  Refusal pause(const std::string& reason = "the user has paused it");
  Refusal resume();
  /// Parks and cools the printer. Heating ends at once.
  Refusal cancel(const std::string& reason = "the user has stopped it");
  /// Sends M112 past every queue; then pulls the board's reset line if the printer does not confirm. It does
  /// not park.
  Refusal emergency_stop();
  /// Sets the speed, 10…300 % of what the print asks for.
  Refusal set_speed(double percent);
  /// Sets the extrusion, 50…200 % of what the print asks for.
  Refusal set_flow(double percent);
  /// Sets the target, °C; 0 is off, absurd ones are refused. The print's own changes of temperature still
  /// come.
  Refusal set_nozzle(double temperature);
  Refusal set_bed(double temperature);

  SessionStatus status() const;
  /// The observer is called after every change and must be quick. It may ask for status() and give commands.
  void on_event(std::function<void(const SessionEvent&)> observer);
  /// The result when the loop itself has failed: cools the printer as well as it can.
  StreamResult failed(std::exception_ptr error);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::host
