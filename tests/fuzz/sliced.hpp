// Fuzz target: damaged files of slicers.
#pragma once

#include <filesystem>

#include "core/numeric/random.hpp"

namespace unicursal::test {

void sliced(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
