// Steering a print from the terminal that it runs in: a word and Enter.
#pragma once

#include <string>

#include "host/engine/session.hpp"

namespace unicursal::host {

/// Obeys "pause", "resume", "cancel", "stop", "speed 80", "flow 95", "nozzle 205", "bed 55"; returns what
/// there is to say about it, empty when nothing is.
std::string obey(Session& session, const std::string& words);

}  // namespace unicursal::host
