// Colours of a chart's patches that a person has measured, as a file: a line for each patch with its
// number and "#rrggbb", or its number, L*, a* and b*, with commas, semicolons or tabs between them:
//
//   patch, L, a, b
//   1, 47.2, 12.5, -40.1
//   2, #e0604a
//
// Patches may be missing, and a first line of words is a heading.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/picture/lab.hpp"

namespace unicursal::host {

struct SeenPatch {
  std::size_t patch = 0;  ///< counted from 0
  picture::Light light{};
  double noise = 1;  ///< how uncertain it is, ΔE
};

/// Throws core::FileError, or core::DataError with the line.
std::vector<SeenPatch> read_measured_colours(const std::filesystem::path& file, std::size_t patches);

}  // namespace unicursal::host
