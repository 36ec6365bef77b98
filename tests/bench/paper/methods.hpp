// The methods that are compared, by name.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "tests/bench/paper/figures.hpp"

namespace unicursal::bench {

inline constexpr std::array<std::string_view, 4> method_names{"ours", "zigzag", "fermat", "growth"};
std::string title_of(std::string_view method);

/// Fills the islands of the part, one after another.
Run run_method(std::string_view method, const Part& part);

/// The processor time of this process, s.
double processor_seconds();

}  // namespace unicursal::bench
