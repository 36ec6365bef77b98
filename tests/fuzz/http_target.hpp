// The daemon's HTTP interface over real sockets: requests that are damaged, cut, forged or random.
#pragma once

#include <filesystem>

#include "core/numeric/random.hpp"

namespace unicursal::test {

/// One conversation. Throws core::DataError if it was refused, and std::runtime_error if the daemon did
/// something that it must not do: answer a stranger, send something other than HTTP, or make files elsewhere.
void http(const std::filesystem::path& folder, core::Random& random);

/// A damaged form of a slicer: cut into any pieces it must be read, or refused, as in one piece.
void form(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
