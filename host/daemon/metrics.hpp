// The daemon's state for Prometheus, in its text format (version 0.0.4).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace unicursal::host {

/// Of a daemon's status; what is not known is left out.
std::string metrics_text(const nlohmann::json& status);

}  // namespace unicursal::host
