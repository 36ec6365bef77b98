// The serial line to a printer: numbered, checksummed lines out, replies in, every line executed once.
// One Asio loop runs it on one thread; nothing here blocks. host/link/state.hpp says how firmwares behave and
// what follows for the link; sim/README.md has all the facts.
//
//   asio::io_context loop;
//   Link link(loop.get_executor(), open_port("/dev/ttyUSB0", 250000), LinkOptions{});
//   co_await link.connect();                 // boot messages, newline, M115, M110
//   std::vector<std::string> lines{"G28", "M105"};
//   co_await link.send(std::move(lines));    // returns when the last line has been written
//   co_await link.drain();                   // returns when every line is acknowledged
#pragma once

#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware_gcode/reply/identity.hpp"
#include "firmware_gcode/reply/reply.hpp"
#include "host/link/link_types.hpp"

namespace unicursal::host {

/// USB numbers of the chip or board at the other end of a cable.
struct UsbId {
  std::uint16_t vendor = 0, product = 0;

  friend bool operator==(const UsbId&, const UsbId&) = default;
};

/// A serial port that a user can choose.
struct PortInfo {
  std::string path;         ///< /dev/ttyUSB0
  std::string stable_path;  ///< /dev/serial/by-id/…; empty if it has none.
  std::string description;
  bool usb = false;
  std::optional<UsbId> usb_id;
};

/// Lists the serial ports, those on USB first.
std::vector<PortInfo> list_ports();

/// Opens a port exclusively, raw, 8N1, with HUPCL cleared; through libserialport for real ports, directly for
/// pseudo-terminals. `path` may also be USB numbers ("1a86:7523") or "auto": the only port on USB, or else
/// the only port; if there are several, the first that answers M115 (host/link/find_port.hpp). Returns the
/// file descriptor, owned by the caller. Throws PortError.
int open_port(const std::string& path, unsigned baud);

/// Like above; also sets options.boot to 0 if opening cannot have reset the board: this program had the port
/// before and DTR has stayed up since, or the printer has just answered.
int open_port(const std::string& path, unsigned baud, LinkOptions& options);

/// The device behind an open port, which is the same for every name of the port; empty if it is unknown.
std::string device_of(int port);

struct LinkState;

class Link {
 public:
  /// Takes ownership of the descriptor.
  Link(asio::any_io_executor executor, int descriptor, LinkOptions options);
  ~Link();
  Link(Link&&) noexcept;

  /// Waits for the firmware, asks M115, resets the line number. Throws LinkError. To be called once.
  asio::awaitable<void> connect();
  /// Instead of connect(): finds out how far a printer got that another program was printing on when it died;
  /// changes nothing. The printer first executes the lines that it has received whole; half a line is ended
  /// and refused. `beyond` is a number that the printer cannot expect next. Throws PrinterReset and
  /// LinkError. To be called once.
  asio::awaitable<Rejoined> rejoin(std::uint32_t beyond);
  /// To be called after rejoin(), with the number of the first line to send.
  void go_on(std::uint32_t next);
  /// Queues lines in order (without number, checksum, newline and comments; at most 80 bytes) and returns
  /// when the last one has been written. Throws LinkError; throws std::invalid_argument for a malformed line,
  /// and then sends none of the lines. Precondition: connected.
  asio::awaitable<void> send(std::vector<std::string> lines);
  /// Returns when every line has been acknowledged. Throws LinkError. Precondition: connected.
  asio::awaitable<void> drain();
  /// Never returns: throws LinkError as soon as the conversation fails, for example since the cable was
  /// pulled, also while nothing is sent.
  asio::awaitable<void> until_failure();
  /// Ends the conversation and returns the port's descriptor, which stays open and locked and is the caller's
  /// from now on; −1 if the port has gone. To be called when drain() has returned.
  int take_port();
  /// Out of band: ends a wait for heat, switches the heaters off, and drops the lines that have no number
  /// yet. Best effort; may be repeated. The conversation continues.
  void cool_down() noexcept;
  /// Whether the printer reports that it waits for a person. It executes nothing meanwhile.
  bool waits_for_user() const;
  /// Out of band: ends that wait, by M108, or by the button that lets the printer go on. No effect unless it
  /// waits.
  void end_wait_for_user() noexcept;
  /// Out of band: presses a button of the question that the printer asks, counted from 0 (M876 S).
  void answer_prompt(std::size_t button) noexcept;
  /// Whether the link has stopped the printer at once after cool_down(), since it did not end its heating.
  bool cut_wait_short() const;
  /// Out of band, at once: M112 ahead of every queue. Best effort; every later send() and drain() throws.
  void emergency_stop() noexcept;

  const LinkStatistics& statistics() const;
  /// The answer to M115 (FIRMWARE_NAME…); empty before connect() and for firmwares without one.
  const std::string& firmware() const;
  /// The same, parsed.
  const gcode::Identity& identity() const;
  /// The latest temperatures that the printer has reported, °C.
  const gcode::Temperatures& temperatures() const;
  /// The queues as of the last ok; nullopt if the firmware does not report them.
  const std::optional<PrinterQueues>& queues() const;
  /// Sets a listener for changes of the numbering: the user's line with index `line` (from 0) will have the
  /// number `number`, and the lines after it count on. It is called before that line is written.
  void on_numbering(std::function<void(std::uint32_t number, std::uint64_t line)> listener);
  /// Sets a listener for every line from the printer that is not a plain ok. The text is safe to display. The
  /// listener must be quick.
  void on_message(std::function<void(const std::string&)> listener);

 private:
  std::shared_ptr<LinkState> state_;
};

}  // namespace unicursal::host
