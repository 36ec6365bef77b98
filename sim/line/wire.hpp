// The cable: ten bits for each byte at the line's baud rate, one byte after the other, in both directions;
// and the USB chip, which collects what the printer says and hands it to the computer in packets. Bytes carry
// a mark when something was lost or changed on the way, so that damage which the firmware does not notice can
// be counted. Printer seconds.
//
// Departure: an FTDI chip's timer runs freely; here it starts with the first byte of a packet, which is the
// slowest that it can be. What the computer sends leaves at once (USB's frames are short against a line).
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace unicursal::sim {

enum class Usb {
  none,  ///< every finished line, or what there is when the printer pauses, is handed over at once
  cdc,   ///< at the next frame of 1 ms
  ftdi,  ///< when 62 bytes are there, or 16 ms after the first
};

struct WireModel {
  double baud = 0;  ///< bits/s; 0: bytes take no time
  Usb usb = Usb::none;
};

/// A byte and whether the line did something to it or just before it.
struct WireByte {
  char value = 0;
  bool damaged = false;
};

class Wire {
 public:
  explicit Wire(const WireModel& model) : model_(model) {}

  /// The computer writes; bytes follow those still on their way.
  void write(double now, const std::vector<WireByte>& bytes);
  /// When the printer next has a whole line more, or all that is on its way.
  std::optional<double> next_arrival() const;
  /// Those bytes that are there by `now`, in order.
  std::vector<WireByte> arrive(double now);

  /// The printer speaks.
  void speak(double now, std::string_view bytes);
  /// When the computer next gets something.
  std::optional<double> next_delivery() const;
  /// What it gets by `now`, at most `longest` bytes; the rest stays.
  std::string deliver(double now, std::size_t longest);

  /// Forgets everything on its way.
  void cut();

 private:
  struct Travelling {
    WireByte byte;
    double at = 0;  ///< when it arrives
  };

  double byte_seconds() const { return model_.baud > 0 ? 10 / model_.baud : 0; }
  std::size_t packet_size() const;

  WireModel model_;
  std::deque<Travelling> down_, up_;  ///< to the printer, to the computer
  double down_free_ = 0, up_free_ = 0;
};

}  // namespace unicursal::sim
