// Where this program keeps what outlives it: prints and the daemon's state.
#pragma once

#include <filesystem>
#include <optional>

namespace unicursal::host {

/// $XDG_STATE_HOME/unicursal, or ~/.local/state/unicursal (XDG Base Directory Specification); absent if the
/// user has no home folder.
std::optional<std::filesystem::path> state_home();

}  // namespace unicursal::host
