// Steers a print from its own terminal, with words that are typed there.
#pragma once

#include <string>

#include "host/engine/session.hpp"

namespace unicursal::host {

/// Runs "pause", "resume", "cancel", "stop", "speed 80", "flow 95", "nozzle 205" or "bed 55". Returns an
/// error sentence, or an empty text.
std::string obey(Session& session, const std::string& words);

}  // namespace unicursal::host
