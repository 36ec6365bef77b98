// What a session says of itself: its state with the reason, warnings, and events for its observer. It belongs
// to the loop's thread.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/engine/session_types.hpp"

namespace unicursal::host {

class Announcer {
 public:
  /// The observer is called after every change, on the loop's thread; it may give commands to the session.
  void observe(std::function<void(const SessionEvent&)> observer) { observer_ = std::move(observer); }

  SessionState state() const { return state_; }
  /// Why the state is what it is, a sentence; may be empty.
  const std::string& reason() const { return reason_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Whether the print is held, or goes there.
  bool holds() const { return state_ == SessionState::pausing || state_ == SessionState::paused; }
  /// Whether the lines that end the print are being sent.
  bool is_ending() const { return state_ == SessionState::finishing || state_ == SessionState::cancelling; }

  void enter(SessionState next, std::string reason = {});
  /// Changes the reason without an event.
  void explain(std::string reason) { reason_ = std::move(reason); }
  void event(SessionEvent::Kind kind, const std::string& text = {}) const;
  void notice(const std::string& sentence) const { event(SessionEvent::Kind::notice, sentence); }
  /// A line from the printer. One that it repeats is shown once, then at the 10th, 100th … time, and with
  /// its count when another follows.
  void quote(const std::string& line);
  /// The printer says nothing more.
  void end_quotes();
  /// A notice that the status keeps; given once, however often it is repeated.
  void warn(const std::string& sentence);

 private:
  std::function<void(const SessionEvent&)> observer_;
  SessionState state_ = SessionState::connecting;
  std::string reason_;
  std::vector<std::string> warnings_;
  std::string quoted_;           ///< the printer's last line
  std::size_t times_ = 0;        ///< that it has said it
  std::size_t times_shown_ = 1;  ///< the count that was shown last
};

}  // namespace unicursal::host
