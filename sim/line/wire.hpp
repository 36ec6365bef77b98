// The cable: ten bits for each byte at the line's baud rate, one byte after the other, in both directions;
// and the USB chip, which hands the printer's bytes to the computer in packets. A byte is marked as damaged
// if it was changed or bytes before it were lost, so that damage which the firmware does not notice can be
// counted. Printer seconds.
//
// Departures: an FTDI chip's timer runs freely; here it starts with the first byte of a packet, which is the
// worst case. Bytes from the computer leave at once, since a USB frame is short compared with a line.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace unicursal::sim {

enum class Usb {
  none,  ///< Delivers every line at once when it is complete, or what there is when the printer pauses.
  cdc,   ///< Delivers at the next frame of 1 ms.
  ftdi,  ///< Delivers when 62 bytes are there, or 16 ms after the first.
};

struct WireModel {
  double baud = 0;  ///< bits/s; 0 = bytes take no time.
  Usb usb = Usb::none;
};

/// A byte, and whether it or a byte just before it was damaged on the line.
struct WireByte {
  char value = 0;
  bool damaged = false;
};

class Wire {
 public:
  explicit Wire(const WireModel& model) : model_(model) {}

  /// The computer writes; the bytes follow those still in transit.
  void write(double now, const std::vector<WireByte>& bytes);
  /// The time at which the next complete line, or else the last byte in transit, reaches the printer.
  std::optional<double> next_arrival() const;
  /// Returns the bytes that have reached the printer by `now`, in order.
  std::vector<WireByte> arrive(double now);

  /// The printer sends bytes.
  void speak(double now, std::string_view bytes);
  /// The time of the next delivery to the computer.
  std::optional<double> next_delivery() const;
  /// Returns the bytes delivered to the computer by `now`. It stops after the packet that reaches `longest`
  /// bytes; the rest stays.
  std::string deliver(double now, std::size_t longest);

  /// Discards everything in transit.
  void cut();

 private:
  struct Travelling {
    WireByte byte;
    double at = 0;  ///< Time of arrival.
  };

  double byte_seconds() const { return model_.baud > 0 ? 10 / model_.baud : 0; }
  std::size_t packet_size() const;

  WireModel model_;
  std::deque<Travelling> down_, up_;  ///< Bytes to the printer, and to the computer.
  double down_free_ = 0, up_free_ = 0;
};

}  // namespace unicursal::sim
