// Damaged files of meshes.
#pragma once

#include <filesystem>

#include "core/numeric/random.hpp"

namespace unicursal::test {

/// A 3MF project with materials, paint and parts: damage in a file of the package, or in the package.
void package(const std::filesystem::path& folder, core::Random& random);
void wavefront(const std::filesystem::path& folder, core::Random& random);
void amf(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
