// Reads a whole file into memory.
#pragma once

#include <filesystem>
#include <string>

namespace unicursal::core {

/// Throws FileError if `file` is not a readable regular file of at most 2 GiB.
std::string file_bytes(const std::filesystem::path& file);

}  // namespace unicursal::core
