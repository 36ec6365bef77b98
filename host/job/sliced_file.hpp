// G-code that a slicer has written, by the name of its file.
#pragma once

#include <filesystem>

namespace unicursal::host {

/// .gcode, .gco, .gc or .g
bool is_sliced_file(const std::filesystem::path& file);

/// Throws JobError for .bgcode, the binary form of such a file, which cannot be read.
void refuse_binary_gcode(const std::filesystem::path& file);

}  // namespace unicursal::host
