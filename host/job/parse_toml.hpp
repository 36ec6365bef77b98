// The only way to TOML: the parser of toml++ 3.3 calls itself for every dot of a key and runs out of stack,
// so the text is scanned first.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>

namespace unicursal::host {

/// Levels that a value may lie below the top: dots of keys and headers, brackets and braces together.
inline constexpr std::size_t deepest_settings = 64;

/// `file` is named in errors. Throws JobError with file and line.
toml::table parse_toml(const std::string& text, const std::filesystem::path& file);

}  // namespace unicursal::host
