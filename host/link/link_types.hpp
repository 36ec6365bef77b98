// The values of a link: its errors, options, statistics, and what it learns of a printer.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>

#include "firmware_gcode/reply/reply.hpp"
#include "host/loop/clock.hpp"

namespace unicursal::host {

class SerialLog;

/// The printer is absent, does not answer, has reset, or has stopped itself. The message is a sentence with
/// the remedy.
class LinkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The port cannot be opened. Nothing was sent to a printer.
class PortError : public LinkError {
 public:
  using LinkError::LinkError;
};

/// The printer answers, but has restarted since the last contact: its line numbers, position and heat are
/// lost.
class PrinterReset : public LinkError {
 public:
  using LinkError::LinkError;
};

struct LinkOptions {
  std::shared_ptr<Clock> clock = real_clock();  ///< Measures all the times below.
  std::size_t receive_buffer = 127;             ///< Bytes that may be in flight (firmware's buffer less one).
  std::chrono::milliseconds boot{3000};         ///< Time to wait for a boot message before asking.
  std::chrono::milliseconds silence{15000};    ///< Longest time without ok or busy; then probe, then give up.
  std::chrono::milliseconds no_ok{600000};     ///< Longest time without ok during a quick command.
  std::chrono::milliseconds slow_ok{3600000};  ///< The same while heating, homing or waiting for a person.
  std::chrono::milliseconds quiet{40};         ///< Time without a byte after which the printer has finished.
  /// Replaces `silence` for firmwares that report every 2 s that they are busy (Cap:BUSY_PROTOCOL).
  std::chrono::milliseconds keepalive{3000};
  /// Interval of temperature reports, whole seconds; 0 = no reports. The printer makes them, or else is
  /// asked.
  std::chrono::seconds temperatures{0};
  std::uint32_t last_number = 99999999;      ///< After this number, lines are counted from 1 again (M110).
  std::shared_ptr<SerialLog> log = nullptr;  ///< Receives every byte in both directions.
};

struct LinkStatistics {
  std::uint64_t lines = 0;         ///< Lines passed to send().
  std::uint64_t sent = 0;          ///< Numbered lines written, including repeats and the link's own queries.
  std::uint64_t acknowledged = 0;  ///< Those of `lines` that the printer has accepted.
  std::uint64_t resends = 0;       ///< Resend requests that were obeyed.
  std::uint64_t probes = 0;        ///< Times that the link had to ask for the printer's line number.
  std::uint64_t queries = 0;       ///< The link's own numbered lines, without repeats.
  std::uint64_t recounts = 0;      ///< Times that the line numbers were restarted from 1.
  std::uint64_t bytes = 0;         ///< Bytes written.
  bool cut = false;                ///< The port has gone: the cable was pulled, or the printer has no power.
};

/// The room in the printer's queues, as ADVANCED_OK reports it. A size is the most that was ever free.
struct PrinterQueues {
  std::uint32_t planner_free = 0, planner_size = 0;    ///< Moves.
  std::uint32_t commands_free = 0, commands_size = 0;  ///< Commands, the running one included.
};

/// The state of a printer in a conversation that another program has begun.
struct Rejoined {
  std::uint32_t next = 0;  ///< Number of the line that it expects next; from Repetier perhaps modulo 65536.
  std::optional<std::array<double, 3>> position;  ///< x y z after everything that it has accepted, mm.
  gcode::Temperatures temperatures;               ///< °C.
};

}  // namespace unicursal::host
