// Whether a printer that was found again is where the journal says, so that the next line can follow.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "host/engine/session_types.hpp"
#include "host/link/link.hpp"
#include "host/spool/chunk_reader.hpp"
#include "host/spool/journal.hpp"

namespace unicursal::host {

/// A line number that the printer cannot be waiting for, nor modulo 65536.
std::uint32_t number_beyond(const JournalState& journal);

/// Why the print cannot simply go on, or nothing: the number must be that of a line of this print which was
/// not yet acknowledged, the nozzle where that line expects it, and the heaters on if the print wants them.
std::optional<Lost> lost_since(const JournalState& journal, const Rejoined& found,
                               const std::filesystem::path& chunks, const SpoolExtent& extent);

}  // namespace unicursal::host
