// Keeps account of numbered lines: which of them wait, which are in flight, and which the firmware may still
// ask for again. It does no input or output; the link drives it.
//
// A firmware accepts lines strictly in the order of their numbers. Numbers are therefore the evidence of what
// it has received, and oks only mean that there is room for more. After a damaged or lost ok, the count of
// acknowledged lines may be wrong by a few lines. Lines are therefore kept for a while after their ok, and
// rewind() corrects the account.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "host/link/move_clock.hpp"

namespace unicursal::host {

/// Returns "N5 G28*…\n" with the checksum of Marlin and Repetier: the XOR of all bytes before the '*'.
std::string framed(std::uint32_t number, std::string_view command);

class Ledger {
 public:
  /// `window` is the number of bytes that may be in flight, `first` the number of the first line, `last` the
  /// number after which numbering must restart.
  explicit Ledger(std::size_t window, std::uint32_t first = 1, std::uint32_t last = highest)
      : window_(window), last_(last), base_(first), front_(first), next_(first), counted_(first) {}

  /// The highest number that leaves 80 bytes for the command in a line of 95.
  static constexpr std::uint32_t highest = 99999999;

  /// Appends a command to the waiting ones.
  void push(std::string command) { waiting_.push_back(std::move(command)); }
  /// Puts as many lines in flight as the window allows and appends them to `bytes`; returns their number.
  /// If nothing is in flight, one line always fits.
  std::size_t fill(std::string& bytes);

  /// Handles an ok without a number, which belongs to the oldest line in flight. Returns false if no line is
  /// in flight, or if the oldest one is a fence, whose answer looks different.
  bool acknowledge();
  /// Handles an ok with a number, which is as sent or modulo 65536. If that line is in flight, it and all
  /// lines before it are acknowledged. Returns true if it is the oldest one in flight. `queued` is the number
  /// of later lines that the firmware has also taken out of its receive buffer, if it reports that; they make
  /// room for others.
  bool acknowledge_number(std::uint32_t number, std::uint32_t queued = 0);
  /// Handles "ok T:…", the answer to the oldest M105 in flight; all lines before it are done, too. Returns
  /// false if no M105 is in flight.
  bool acknowledge_query();

  /// Returns the line that a firmware means when it asks for `number`: a line that is still kept, or the one
  /// after the last numbered line (also after a rewind, since that may have followed a damaged number).
  /// Repetier counts modulo 65536. Returns nullopt if it is neither.
  std::optional<std::uint32_t> locate(std::uint32_t number) const;
  /// The firmware has everything before `number` and nothing from there on. Precondition: locate() has
  /// returned `number`.
  void rewind(std::uint32_t number);
  /// Inserts an M105 after the last numbered line, ahead of the waiting ones, unless one is already in
  /// flight. Its answer proves that everything before it has been executed. Returns whether it was inserted.
  bool fence();
  /// The number of the user's lines that have a line number, and the line number that the next one will get.
  std::uint64_t numbered() const { return numbered_; }
  std::uint32_t next_to_number() const { return end(); }
  /// Whether restart() is due: lines wait, no number is left for them, and all lines before them are done.
  bool exhausted() const { return end() > last_ && !waiting_.empty() && next_ == end() && !in_flight(); }
  /// The firmware counts from 1 again. Precondition: nothing is in flight.
  void restart();

  /// The number of bytes that may be in flight.
  std::size_t window() const { return window_; }
  void halve_window() { window_ /= 2; }

  bool in_flight() const { return front_ < next_; }
  /// Whether one of the lines sent recently may keep the firmware busy for long: heating, homing, a pause.
  /// Acknowledged lines count as well, since some firmwares say ok when a command is queued.
  bool slow() const;
  /// The same without the acknowledged lines.
  bool slow_in_flight() const;
  /// The oldest line without an ok waits for heat or for a person, and is before the line `beyond`.
  bool waits_before(std::uint32_t beyond) const;
  /// Whether a line has moved the printer.
  bool has_moved() const { return has_moved_; }
  /// Whether every line in flight takes a time that is known.
  bool all_timed() const;
  /// s of motion of the lines that were acknowledged since the last call.
  double take_acknowledged_seconds() { return std::exchange(fresh_seconds_, 0); }
  /// s of motion that the last acknowledged lines may still have left in the printer's queue of moves.
  double queued_seconds() const;
  /// Drops the lines without a number; returns how many.
  std::size_t forget_waiting() { return std::exchange(waiting_, {}).size(); }
  /// Whether the oldest line in flight is a fence: plain oks are then late ones of earlier lines.
  bool at_fence() const { return in_flight() && line(front_).fence; }
  bool all_written() const { return waiting_.empty() && next_ == end(); }
  bool settled() const { return all_written() && !in_flight(); }
  /// The oldest line in flight: its number, and its command without number and checksum. Precondition:
  /// in_flight().
  std::uint32_t oldest() const { return front_; }
  std::string_view oldest_command() const;
  /// The number of the next line to be written.
  std::uint32_t next() const { return next_; }
  /// The number of the user's commands that are acknowledged.
  std::uint64_t acknowledged() const { return acknowledged_; }

 private:
  struct Line {
    std::string frame;
    bool query = false;             ///< Whether it is an M105.
    bool slow = false;              ///< Whether it can take long: M109, G28 and the like.
    bool fence = false;             ///< Whether the link inserted it.
    std::optional<double> seconds;  ///< How long it takes; absent if that is not known.
  };

  std::uint32_t end() const { return base_ + static_cast<std::uint32_t>(lines_.size()); }
  Line& line(std::uint32_t number) { return lines_[number - base_]; }
  const Line& line(std::uint32_t number) const { return lines_[number - base_]; }
  bool slow_since(std::uint32_t number) const;
  void number(std::string_view command, bool fence);
  void advance(std::uint32_t front);
  void leave_buffer(std::uint32_t front);
  void forget();

  std::size_t window_;
  std::deque<std::string> waiting_;  ///< Commands without a number.
  std::deque<Line> lines_;           ///< Lines base_ … end() - 1.
  std::uint32_t last_;
  std::uint32_t base_;
  std::uint32_t front_;    ///< The oldest line in flight.
  std::uint32_t next_;     ///< The next line to write; before end() after a rewind.
  std::uint32_t counted_;  ///< The oldest line that may still be in the receive buffer.
  std::size_t bytes_in_buffer_ = 0;
  MoveClock move_clock_;
  bool has_moved_ = false;
  double fresh_seconds_ = 0;
  std::uint64_t numbered_ = 0;
  std::uint64_t acknowledged_ = 0;
};

}  // namespace unicursal::host
