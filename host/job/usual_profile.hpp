// The profile that is used if none is named.
#pragma once

#include <filesystem>
#include <optional>

namespace unicursal::host {

/// unicursal/printer.toml in $XDG_CONFIG_HOME or ~/.config; nullopt if the user has no such folder.
std::optional<std::filesystem::path> own_profile_path();
/// The same if the file exists.
std::optional<std::filesystem::path> own_profile();

/// A shipped profile to try models with: three feeders, a nozzle of 0.6 mm, a bed of 200 mm. The file is
/// written to unicursal/frames in the state folder. Throws core::FileError.
std::filesystem::path common_frame();

}  // namespace unicursal::host
