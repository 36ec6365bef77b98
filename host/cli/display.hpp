// The progress of a print. On a terminal it is one line that is rewritten; elsewhere it is a line for each
// tenth of the print; both go to standard error. Or it is JSON on standard output: one event on each line.
// Showing never waits (host/loop/outlet.hpp).
#pragma once

#include <chrono>
#include <string>

#include "host/engine/session.hpp"
#include "host/loop/outlet.hpp"

namespace unicursal::host {

enum class DisplayForm { words, json };

class Display {
 public:
  explicit Display(DisplayForm form);
  /// Erases the progress line.
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  void show(const Session& session, const SessionEvent& event);
  /// A sentence that no session says, shown like a notice of one.
  void notice(const std::string& sentence);
  /// Shows the answer to words that were typed.
  void answer(const std::string& sentence);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const SessionStatus& status);
  void say(const std::string& sentence);
  void clear();
  void write(const SessionEvent& event, const SessionStatus& status);
  bool is_due(std::chrono::milliseconds interval);

  DisplayForm form_;
  bool terminal_;
  Outlet messages_;  ///< standard error
  Outlet events_;    ///< standard output
  bool drawn_ = false;
  int last_tenth_ = -1;
  Clock::time_point last_{};
};

/// Returns the progress line, cut to `width` characters: state, layer, per cent, time left, temperatures,
/// mixture, look-ahead, queue.
std::string status_line(const SessionStatus& status, std::size_t width);

}  // namespace unicursal::host
