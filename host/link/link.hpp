// The serial line to a printer: numbered, checksummed lines out, replies in, every line executed once.
// One Asio loop runs it on one thread; nothing here blocks. How firmwares behave, and what follows from that,
// stands in link.cpp.
//
//   asio::io_context loop;
//   Link link(loop.get_executor(), open_port("/dev/ttyUSB0", 250000), LinkOptions{});
//   co_await link.connect();                 // boot chatter, newline, M110
//   std::vector<std::string> lines{"G28", "M105"};
//   co_await link.send(std::move(lines));    // returns when the last line is on its way
//   co_await link.drain();                   // returns when every line has its ok
#pragma once

#include <array>
#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware_gcode/reply/identity.hpp"
#include "firmware_gcode/reply/reply.hpp"
#include "host/loop/clock.hpp"

namespace unicursal::host {

class SerialLog;

/// The printer is not there, does not answer, has reset, or has stopped itself. The message is a sentence
/// with the remedy.
class LinkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A port that cannot be opened: nothing was sent to any printer.
class PortError : public LinkError {
 public:
  using LinkError::LinkError;
};

/// The printer is there, but has started anew since it was last heard of: its line numbers, position and heat
/// are gone.
class PrinterReset : public LinkError {
 public:
  using LinkError::LinkError;
};

/// Of the chip or board at the other end of a USB cable.
struct UsbId {
  std::uint16_t vendor = 0, product = 0;

  friend bool operator==(const UsbId&, const UsbId&) = default;
};

/// A port that can be offered to a user.
struct PortInfo {
  std::string path;         ///< /dev/ttyUSB0
  std::string stable_path;  ///< /dev/serial/by-id/…, empty when there is none
  std::string description;
  bool usb = false;
  std::optional<UsbId> usb_id;
};

/// Those on USB first.
std::vector<PortInfo> list_ports();

/// Opens exclusively, raw, 8N1, HUPCL cleared; libserialport for real ports, directly for pseudo-terminals.
/// `path` may also be USB numbers ("1a86:7523"), or "auto": the only port on USB, or else the only port, that
/// there is; where there are several, the first that answers M115 (find_port.hpp). Returns the file
/// descriptor, owned by the caller. Throws PortError.
int open_port(const std::string& path, unsigned baud);
/// The device behind an open port: the same for every name that it has.
std::string device_of(int port);

struct LinkOptions {
  std::shared_ptr<Clock> clock = real_clock();  ///< that the times below are measured by
  std::size_t receive_buffer = 127;             ///< bytes that may be in flight (firmware's buffer less one)
  std::chrono::milliseconds boot{3000};         ///< how long to wait for a boot message before asking
  std::chrono::milliseconds silence{15000};     ///< neither ok nor busy from the printer: probe, then give up
  std::chrono::milliseconds no_ok{600000};      ///< signs of life but no ok from a quick command: give up
  std::chrono::milliseconds slow_ok{3600000};   ///< the same while heating, homing or waiting for a person
  std::chrono::milliseconds quiet{40};          ///< without a byte: all that the printer had to say is said
  /// The same as `silence` for firmwares that say every 2 s that they are busy (Cap:BUSY_PROTOCOL).
  std::chrono::milliseconds keepalive{3000};
  /// Between reports of temperatures, which the printer is told to make, or else asked for; 0: no reports.
  /// Whole seconds.
  std::chrono::seconds temperatures{0};
  std::uint32_t last_number = 99999999;      ///< after it, lines are counted from 1 anew (M110)
  std::shared_ptr<SerialLog> log = nullptr;  ///< of every byte either way
};

/// The same, and nothing is waited for (`boot` becomes 0) where opening cannot have reset the board: this
/// program had the port before and has kept DTR up since, or the printer has just answered.
int open_port(const std::string& path, unsigned baud, LinkOptions& options);

/// The device behind an open port, which is the same whatever name it was opened by; empty if that is
/// unknown.
std::string device_of(int port);

struct LinkStatistics {
  std::uint64_t lines = 0;         ///< lines handed to send()
  std::uint64_t sent = 0;          ///< numbered lines written, repeats and the link's own queries included
  std::uint64_t acknowledged = 0;  ///< of `lines`, those that the printer has taken
  std::uint64_t resends = 0;       ///< resend requests obeyed
  std::uint64_t probes = 0;        ///< times the link had to ask where the printer is
  std::uint64_t queries = 0;       ///< numbered lines of the link's own, each once
  std::uint64_t recounts = 0;      ///< times the lines were numbered from 1 anew
  std::uint64_t bytes = 0;         ///< written
};

/// What the printer's queues have room for, as ADVANCED_OK tells it.
struct PrinterQueues {
  std::uint32_t planner_free = 0, planner_size = 0;    ///< moves; the most that were ever free
  std::uint32_t commands_free = 0, commands_size = 0;  ///< the running one counts
};

/// Where a printer is in a conversation that another program has begun.
struct Rejoined {
  std::uint32_t next = 0;                         ///< number of the line that it wants; Repetier: perhaps
                                                  ///< modulo 65536
  std::optional<std::array<double, 3>> position;  ///< mm, x y z after all that it has taken
  gcode::Temperatures temperatures;               ///< °C
};

class Link {
 public:
  /// Takes over the descriptor.
  Link(asio::any_io_executor executor, int descriptor, LinkOptions options);
  ~Link();
  Link(Link&&) noexcept;

  /// Waits for the firmware, asks M115, resets the line number. Throws LinkError. Once.
  asio::awaitable<void> connect();
  /// Instead of connect(): finds out where a printer is that another program was talking to when it died,
  /// changing nothing. What that program had sent is executed first, as far as it arrived whole; half a line
  /// is ended and refused. `beyond`: a number that the printer cannot expect next. Throws PrinterReset,
  /// LinkError. Once.
  asio::awaitable<Rejoined> rejoin(std::uint32_t beyond);
  /// After rejoin(): the number of the first line to be sent.
  void go_on(std::uint32_t next);
  /// Queues lines in order (no number, no checksum, no newline, no comments; at most 80 bytes) and returns
  /// when the last one has been written. Throws LinkError; std::invalid_argument for a malformed line, in
  /// which case none of the lines is sent. Precondition: connected.
  asio::awaitable<void> send(std::vector<std::string> lines);
  /// Returns when every line has been acknowledged. Throws LinkError. Precondition: connected.
  asio::awaitable<void> drain();
  /// Out of band: ends a wait for heat and switches the heaters off; lines that have no number yet are
  /// forgotten. Best effort, may be repeated. The conversation goes on.
  void cool_down() noexcept;
  /// Whether the printer says that it waits for a person: it runs nothing meanwhile.
  bool waits_for_user() const;
  /// Out of band: ends that wait (M108).
  void end_wait_for_user() noexcept;
  /// Out of band, now: M112 past every queue. Best effort; every later send() and drain() throws.
  void emergency_stop() noexcept;

  const LinkStatistics& statistics() const;
  /// What M115 answered (FIRMWARE_NAME…), empty before connect() and for firmwares that do not tell.
  const std::string& firmware() const;
  /// The same, understood.
  const gcode::Identity& identity() const;
  /// The last that the printer has told; °C.
  const gcode::Temperatures& temperatures() const;
  /// As of the last ok; nothing from firmwares that do not tell.
  const std::optional<PrinterQueues>& queues() const;
  /// Called when the numbers of the user's lines shift: the `line`th of them, counted from 0, will be
  /// `number`, and those behind it follow on. Always before that line is written.
  void on_numbering(std::function<void(std::uint32_t number, std::uint64_t line)> listener);
  /// Called with every line from the printer that is not a plain ok, made safe to show; keep it short.
  void on_message(std::function<void(const std::string&)> listener);

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace unicursal::host
