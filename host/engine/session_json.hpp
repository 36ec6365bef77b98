// Sessions as JSON: for scripts, for the daemon's clients. Keys are snake_case with their unit; what is not
// known is left out.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/engine/session_types.hpp"

namespace unicursal::host {

nlohmann::json to_json(const SessionStatus& status);
/// {"event": "state", "text": …, "status": {…}}
nlohmann::json to_json(const SessionEvent& event, const SessionStatus& status);

/// "completed", "stopped", "failed".
const char* name(Ending ending);

}  // namespace unicursal::host
