// Whether a printer that was found again is where the journal expects it, so that the next line can follow.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "host/engine/session_types.hpp"
#include "host/link/link.hpp"
#include "host/spool/chunk_reader.hpp"
#include "host/spool/journal.hpp"

namespace unicursal::host {

/// A line number that the printer cannot be waiting for, not even modulo 65536.
std::uint32_t number_beyond(const JournalState& journal);

/// The place of the next line in the leg: the printer reports its number, or, if it does not count lines, the
/// place of its nozzle is that between two of the last lines. nullopt if it cannot be a place of this leg.
std::optional<std::uint64_t> place_found(const JournalState& journal, const Rejoined& found,
                                         const std::filesystem::path& chunks);

/// Why the print cannot simply continue; absent if it can. The printer must wait for a line of this print
/// that was not yet acknowledged, its nozzle must be where that line expects it, and its heaters must be on
/// if the print needs them.
std::optional<Lost> lost_since(const JournalState& journal, const Rejoined& found,
                               const std::filesystem::path& chunks, const SpoolExtent& extent);

}  // namespace unicursal::host
