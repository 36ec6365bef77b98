#include "host/engine/announcer.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace unicursal::host {

void Announcer::enter(SessionState next, std::string reason) {
  state_ = next;
  reason_ = std::move(reason);
  event(SessionEvent::Kind::state);
}

void Announcer::event(SessionEvent::Kind kind, const std::string& text) const {
  if (observer_) observer_({kind, text});
}

void Announcer::quote(const std::string& line) {
  if (times_ > 0 && line == quoted_) {
    if (++times_ < 10 * times_shown_) return;
    times_shown_ = times_;
    return event(SessionEvent::Kind::printer, fmt::format("{} ({} times so far)", line, times_));
  }
  end_quotes();
  quoted_ = line;
  times_ = times_shown_ = 1;
  event(SessionEvent::Kind::printer, line);
}

void Announcer::end_quotes() {
  if (times_ > times_shown_)
    event(SessionEvent::Kind::printer, fmt::format("{} ({} times)", quoted_, times_));
  times_ = 0;
}

void Announcer::warn(const std::string& sentence) {
  if (std::find(warnings_.begin(), warnings_.end(), sentence) != warnings_.end()) return;
  warnings_.push_back(sentence);
  notice("Warning: " + sentence);
}

}  // namespace unicursal::host
