// Lays the lines of a method on the simulator's bed and draws what came of it. mm.
#pragma once

#include <filesystem>
#include <vector>

#include "tests/bench/paper/figures.hpp"

namespace unicursal::bench {

/// Sets the figures of both beds and the names of both pictures. `areas`: of all segments of each island. The
/// motors are left out: every segment gets exactly its plastic, so that only the lines count.
void lay_and_draw(const Part& part, const Run& run, const std::vector<std::vector<double>>& areas,
                  const std::filesystem::path& folder, Figures& result);

}  // namespace unicursal::bench
