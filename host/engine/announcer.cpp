#include "host/engine/announcer.hpp"

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

void Announcer::warn(const std::string& sentence) {
  if (std::find(warnings_.begin(), warnings_.end(), sentence) != warnings_.end()) return;
  warnings_.push_back(sentence);
  notice("Warning: " + sentence);
}

}  // namespace unicursal::host
