// Steers a print from its own terminal, with words that are typed there.
#pragma once

#include <string>

#include "host/engine/session.hpp"

namespace unicursal::host {

/// Runs "pause", "resume", "cancel", "stop", "answer 0", "speed 80", "flow 95", "nozzle 205" or "bed 55".
/// Returns what has come of it, a sentence; empty if no word was typed, or if the session itself gives a
/// notice of what it does.
std::string obey(Session& session, const std::string& words);

}  // namespace unicursal::host
