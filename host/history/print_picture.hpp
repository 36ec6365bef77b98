// The small picture of a print that the history keeps.
#pragma once

#include <filesystem>
#include <string>

#include "host/engine/production.hpp"

namespace unicursal::host {

/// The first layer as it was planned, or of a slicer's file; PNG. `chunks`: of the print's spool. Empty if it
/// cannot be drawn.
std::string print_picture(const Production& production, const std::filesystem::path& chunks) noexcept;

}  // namespace unicursal::host
