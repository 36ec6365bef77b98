#include "host/files/state_home.hpp"

#include <cstdlib>

namespace unicursal::host {

std::optional<std::filesystem::path> state_home() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state && *state == '/') return std::filesystem::path(state) / "unicursal";
  const char* home = std::getenv("HOME");
  if (home && *home == '/') return std::filesystem::path(home) / ".local/state/unicursal";
  return std::nullopt;
}

}  // namespace unicursal::host
