// The daemon's state for Prometheus, in its text format (version 0.0.4).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace unicursal::host {

/// `status`: as Daemon::status() returns it; unknown values are left out.
std::string metrics_text(const nlohmann::json& status);

}  // namespace unicursal::host
