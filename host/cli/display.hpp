// The progress of a print. On a terminal it is one line that is rewritten, and below it, if keys come singly
// (host/cli/keyboard.hpp), the line that a person is typing; elsewhere it is a line for each tenth of the
// print; both go to standard error. Or it is JSON on standard output: one event on each line. Showing never
// waits (host/loop/outlet.hpp).
#pragma once

#include <chrono>
#include <string>

#include "host/cli/keyboard.hpp"
#include "host/cli/status_line.hpp"
#include "host/cli/terminal_look.hpp"
#include "host/engine/session.hpp"
#include "host/loop/outlet.hpp"

namespace unicursal::host {

enum class DisplayForm {
  words,
  urgent_words,  ///< only what goes wrong, and what waits for a person
  json
};

class Display {
 public:
  /// `look.colours` is replaced by what the terminal can show.
  explicit Display(DisplayForm form, StatusLook look = {});
  /// Erases the progress line.
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  void show(const Session& session, const SessionEvent& event);
  /// A sentence that no session says, shown like a notice of one.
  void notice(const std::string& sentence);
  /// Shows the line that is being typed.
  void typing(const std::string& text);
  /// A line has been typed: it stays on the screen.
  void typed(const std::string& words);
  /// Shows the answer to words that were typed.
  void answer(const std::string& sentence);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const SessionStatus& status);
  void draw_again();
  void say(const std::string& sentence);
  /// The state with its reason, if it has one.
  void say_why(const SessionStatus& status);
  void clear();
  void write(const SessionEvent& event, const SessionStatus& status);
  bool is_due(std::chrono::milliseconds interval);
  void time_dry_run(double percent);

  DisplayForm form_;
  TerminalLook terminal_;
  StatusLook look_;
  std::optional<Keyboard> keyboard_;  ///< on a terminal that shows the progress line
  Outlet messages_;                   ///< standard error
  Outlet events_;                     ///< standard output
  SessionStatus last_status_;
  std::string typing_;
  bool drawn_ = false;
  int last_tenth_ = -1;
  Clock::time_point last_{};
  std::optional<Clock::time_point> dry_run_began_;  ///< its first layer
};

}  // namespace unicursal::host
