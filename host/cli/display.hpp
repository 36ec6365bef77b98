// What a print shows while it runs: one line that is rewritten on a terminal, an occasional plain line
// elsewhere, both on standard error; or events as JSON, one object on each line of standard output.
#pragma once

#include <chrono>
#include <string>

#include "host/engine/session.hpp"

namespace unicursal::host {

enum class DisplayForm { words, json };

class Display {
 public:
  explicit Display(DisplayForm form);
  /// Takes the line away.
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  void show(const Session& session, const SessionEvent& event);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const SessionStatus& status);
  void say(const std::string& sentence);
  void clear();
  void write(const SessionEvent& event, const SessionStatus& status);
  bool is_due(std::chrono::milliseconds interval);

  DisplayForm form_;
  bool terminal_;
  bool drawn_ = false;
  int last_tenth_ = -1;
  Clock::time_point last_{};
};

/// The line: state, layer, per cent, time left, temperatures, mixture, look-ahead, queue; cut to `width`.
std::string status_line(const SessionStatus& status, std::size_t width);

}  // namespace unicursal::host
