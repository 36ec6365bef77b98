// The text of a profile as a form shows it: each key with its value, and changes of values that leave
// everything else in the text as it is.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace unicursal::host {

/// [{"key", "value", "unit", "takes", "help"}]; "value" is absent where the text says nothing. Keys of the
/// second [[filament]] are called "filament.2.name". Throws JobError.
nlohmann::json profile_form(const std::string& text, const std::filesystem::path& file);

/// `text` with {"printer.nozzle": 0.6, …}. Throws JobError, also for a value that is not allowed.
std::string with_values(const std::string& text, const nlohmann::json& values,
                        const std::filesystem::path& file);

}  // namespace unicursal::host
