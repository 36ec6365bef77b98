// The part of a report that is known at the end of a print: how it ended, the serial line, the planning.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/engine/session_types.hpp"
#include "host/report/books.hpp"

namespace unicursal::host {

/// Writes the report of a print, however it ended, with the keys of `extra` added. Throws PrintError if the
/// print has failed, or if only the report could not be written, and PrinterUnfit if the printer was refused.
void conclude(Books& books, const StreamResult& result, const nlohmann::json& extra);

/// The report's "planning": seconds, cpu_seconds, threads.
nlohmann::json planning_json(const Planning& planning);
/// The report's "link".
nlohmann::json link_json(const StreamResult& result);

}  // namespace unicursal::host
