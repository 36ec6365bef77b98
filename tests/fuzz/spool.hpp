// What is read back of a print that was cut short: damaged journals and chunks.
#pragma once

#include <filesystem>

#include "tests/core/support/random_islands.hpp"

namespace unicursal::test {

void journal(const std::filesystem::path& folder, core::Random& random);
void chunks(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
