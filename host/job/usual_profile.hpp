// The profile that is used if none is named.
#pragma once

#include <filesystem>
#include <optional>

namespace unicursal::host {

/// unicursal/printer.toml in $XDG_CONFIG_HOME or ~/.config; nullopt if it does not exist.
std::optional<std::filesystem::path> own_profile();

/// A profile of a common printer, to try models without one: three feeders, a nozzle of 0.6 mm, a bed of 200
/// mm. The file is written to unicursal/frames in the state folder. Throws core::FileError.
std::filesystem::path common_frame();

}  // namespace unicursal::host
