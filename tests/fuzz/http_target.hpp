// The daemon's HTTP surface, over real sockets, under requests that are damaged, cut, forged or noise.
#pragma once

#include <filesystem>

#include "core/numeric/random.hpp"

namespace unicursal::test {

/// One conversation. Throws core::DataError when it was refused, and std::runtime_error when the daemon has
/// done what it must not: answer strangers, answer something that is no HTTP, or make files elsewhere.
void http(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
