// The serial line to a printer: numbered, checksummed lines out, replies in, every line executed once.
// One Asio loop runs it; nothing here blocks. Firmware behaviour: docs "firmware facts" as quoted in link.cpp.
//
//   asio::io_context loop;
//   Link link(loop.get_executor(), open_port("/dev/ttyUSB0", 250000), LinkOptions{});
//   co_await link.connect();                 // boot chatter, newline, M110
//   co_await link.send({"G28", "M105"});     // returns when the last line is on its way
//   co_await link.drain();                   // returns when every line has its ok
#pragma once

#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace unicursal::host {

/// The printer is not there, does not answer, has reset, or has stopped itself. The message is a sentence
/// with the remedy.
class LinkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A port that can be offered to a user.
struct PortInfo {
  std::string path;         ///< /dev/ttyUSB0
  std::string stable_path;  ///< /dev/serial/by-id/…, empty when there is none
  std::string description;
};

std::vector<PortInfo> list_ports();

/// Opens exclusively, raw, 8N1, HUPCL cleared; libserialport for real ports, directly for pseudo-terminals.
/// "auto" takes the only serial port there is. Returns the file descriptor, owned by the caller.
/// Throws LinkError.
int open_port(const std::string& path, unsigned baud);

struct LinkOptions {
  std::size_t receive_buffer = 127;              ///< bytes that may be in flight (firmware's buffer less one)
  std::chrono::milliseconds boot{3000};          ///< how long to wait for a boot message before asking
  std::chrono::milliseconds silence{15000};      ///< no line at all from the printer: probe, then give up
  std::chrono::milliseconds no_ok{600000};       ///< lines but no ok (heating, homing)
};

struct LinkStatistics {
  std::uint64_t lines = 0;     ///< lines handed to send()
  std::uint64_t sent = 0;      ///< lines written, repeats included
  std::uint64_t acknowledged = 0;
  std::uint64_t resends = 0;   ///< resend requests obeyed
  std::uint64_t bytes = 0;     ///< written
};

class Link {
 public:
  /// Takes over the descriptor.
  Link(asio::any_io_executor executor, int descriptor, LinkOptions options);
  ~Link();
  Link(Link&&) noexcept;

  /// Waits for the firmware, asks M115, resets the line number. Throws LinkError.
  asio::awaitable<void> connect();
  /// Queues lines in order (no number, no checksum, no newline, no comments; at most 80 bytes) and returns
  /// when the last one has been written. Throws LinkError; std::invalid_argument for a malformed line.
  asio::awaitable<void> send(std::vector<std::string> lines);
  /// Returns when every line has been acknowledged.
  asio::awaitable<void> drain();
  /// Out of band, now: M112 past every queue. Best effort.
  void emergency_stop() noexcept;

  const LinkStatistics& statistics() const;
  /// What M115 answered (FIRMWARE_NAME…), empty before connect().
  const std::string& firmware() const;
  /// Called with every line from the printer that is not a plain ok; keep it short.
  void on_message(std::function<void(const std::string&)> listener);

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace unicursal::host
