// What a print has taken, read from its spool. mm of filament.
#pragma once

#include <cstddef>
#include <filesystem>

#include "firmware_gcode/print/per_feeder.hpp"
#include "host/spool/journal.hpp"

namespace unicursal::host {

/// How far each feeder has turned in all legs of the print. Of a leg that was given up, only acknowledged
/// lines count: the printer has lost the others. Throws SpoolError.
gcode::PerFeeder fed_by_print(const std::filesystem::path& chunks, const JournalState& journal,
                              std::size_t feeders);

/// The layers whose lines were all passed to the printer. Throws SpoolError.
std::size_t layers_passed(const std::filesystem::path& chunks, const JournalState& journal);

}  // namespace unicursal::host
