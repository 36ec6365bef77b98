// Fuzz target: photos of test prints, with damaged files and with marks where nobody expects them.
#pragma once

#include <filesystem>

#include "core/numeric/random.hpp"

namespace unicursal::test {

void photo(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
