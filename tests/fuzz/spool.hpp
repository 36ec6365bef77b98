// Damaged journals and chunks of an interrupted print.
#pragma once

#include <filesystem>

#include "tests/core/support/random_islands.hpp"

namespace unicursal::test {

void journal(const std::filesystem::path& folder, core::Random& random);
void chunks(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
