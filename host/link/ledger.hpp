// The account of numbered lines: which wait, which are in flight, which may still be asked for again.
// No input or output; the link drives it.
//
// A firmware takes lines strictly in order of their numbers, so numbers are the evidence of what it has, and
// oks only tell when there is room for more. What the account calls acknowledged may be wrong by a few lines
// after a damaged or lost ok; lines are therefore kept for a while after that, and a rewind puts it right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace unicursal::host {

/// "N5 G28*…\n" with the checksum that Marlin and Repetier share: all bytes before the '*' XORed.
std::string framed(std::uint32_t number, std::string_view command);

class Ledger {
 public:
  /// `window`: bytes that may be in flight. `first`: the number of the first line.
  /// `last`: the number after which they have to begin anew.
  explicit Ledger(std::size_t window, std::uint32_t first = 1, std::uint32_t last = highest)
      : window_(window), last_(last), base_(first), front_(first), next_(first), counted_(first) {}

  /// The highest number that leaves 80 bytes for the command in a line of 95.
  static constexpr std::uint32_t highest = 99999999;

  /// Puts a command behind all that wait.
  void push(std::string command) { waiting_.push_back(std::move(command)); }
  /// Moves as many lines in flight as the window allows and appends them to `bytes`; returns how many.
  /// One line always fits when nothing is in flight.
  std::size_t fill(std::string& bytes);

  /// An ok without a number: it belongs to the oldest line in flight. False when there is none, or when that
  /// line is a fence, whose answer looks different.
  bool acknowledge();
  /// An ok with a number, as sent or modulo 65536. False unless it is the oldest line's; all up to it are
  /// acknowledged when it is in flight. `queued`: how many lines behind it the firmware has taken out of its
  /// receive buffer as well, where it tells; they leave room for others.
  bool acknowledge_number(std::uint32_t number, std::uint32_t queued = 0);
  /// "ok T:…": the answer to the oldest M105 in flight; all before it are done, too. False when there is
  /// none.
  bool acknowledge_query();

  /// The line that a firmware means when it asks for `number`: one that is still kept, or the one after the
  /// last numbered (also after a rewind: the number that led to it may have been a damaged one). Repetier
  /// counts modulo 65536. None when it is neither.
  std::optional<std::uint32_t> locate(std::uint32_t number) const;
  /// The firmware has everything before `number` and nothing from there on. Precondition: located.
  void rewind(std::uint32_t number);
  /// Lets a M105 follow the last numbered line, ahead of what waits, unless one is already under way: its
  /// answer is proof that everything before it has been executed. Returns whether it was inserted.
  bool fence();
  /// Lines of the user that have a number, and the number that the next one of them will get.
  std::uint64_t numbered() const { return numbered_; }
  std::uint32_t next_to_number() const { return end(); }
  /// No number is left for what waits, and all before it is done: restart() is due.
  bool exhausted() const { return end() > last_ && !waiting_.empty() && next_ == end() && !in_flight(); }
  /// The firmware now counts from 1 again. Precondition: nothing is in flight.
  void restart();

  bool in_flight() const { return front_ < next_; }
  /// Whether one of the lines sent lately may keep the firmware busy for long: heating, homing, a pause.
  /// Lately, since some firmwares say ok when a command is queued.
  bool slow() const;
  /// Drops what has no number yet; returns how many.
  std::size_t forget_waiting() { return std::exchange(waiting_, {}).size(); }
  /// Whether the oldest line in flight is a fence: plain oks are then late ones of lines before it.
  bool at_fence() const { return in_flight() && line(front_).fence; }
  bool all_written() const { return waiting_.empty() && next_ == end(); }
  bool settled() const { return all_written() && !in_flight(); }
  /// The number of the next line to be written.
  std::uint32_t next() const { return next_; }
  /// Commands of the user that are acknowledged.
  std::uint64_t acknowledged() const { return acknowledged_; }

 private:
  struct Line {
    std::string frame;
    bool query = false;  ///< M105
    bool slow = false;   ///< M109, G28 and the like
    bool fence = false;  ///< the link's own
  };

  std::uint32_t end() const { return base_ + static_cast<std::uint32_t>(lines_.size()); }
  Line& line(std::uint32_t number) { return lines_[number - base_]; }
  const Line& line(std::uint32_t number) const { return lines_[number - base_]; }
  void number(std::string_view command, bool fence);
  void advance(std::uint32_t front);
  void leave_buffer(std::uint32_t front);
  void forget();

  std::size_t window_;
  std::deque<std::string> waiting_;  ///< not numbered yet
  std::deque<Line> lines_;           ///< numbers base_ … end() - 1
  std::uint32_t last_;
  std::uint32_t base_;
  std::uint32_t front_;    ///< the oldest in flight
  std::uint32_t next_;     ///< the next to write; before end() after a rewind
  std::uint32_t counted_;  ///< the oldest that may still be in the receive buffer
  std::size_t bytes_in_buffer_ = 0;
  std::uint64_t numbered_ = 0;
  std::uint64_t acknowledged_ = 0;
};

}  // namespace unicursal::host
