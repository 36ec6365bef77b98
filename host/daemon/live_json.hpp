// The line of a print as API.md has it ("A print going on").
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "host/live/live_line.hpp"

namespace unicursal::host {

nlohmann::json to_json(const LiveOverview& overview);
nlohmann::json to_json(const KnownLayer& layer);
/// The nozzle, without "event".
nlohmann::json to_json(const LiveNozzle& nozzle);
/// The bytes of GET /api/print/layers/N/path.
std::string to_bytes(const PathPiece& piece);

}  // namespace unicursal::host
