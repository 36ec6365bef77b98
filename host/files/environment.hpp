// Variables of the environment.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace unicursal::host {

/// Absent if the variable is unset or empty, which conventions take for the same.
inline std::optional<std::string> environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr || *value == 0 ? std::nullopt : std::optional<std::string>(value);
}

}  // namespace unicursal::host
