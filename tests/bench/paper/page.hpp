// The page of the comparison: claims first, then each part with its pictures and figures, then the paper's
// series. It refers to nothing but the pictures beside it.
#pragma once

#include <filesystem>
#include <vector>

#include "tests/bench/paper/claims.hpp"

namespace unicursal::bench {

/// Writes `folder`/index.html. Throws std::system_error.
void write_page(const std::filesystem::path& folder, const Report& report, const std::vector<Claim>& claims);

}  // namespace unicursal::bench
