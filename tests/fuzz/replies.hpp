// Damaged replies of simulated printers (tests/data/replies), for their readers and for the link.
#pragma once

#include <filesystem>

#include "core/numeric/random.hpp"

namespace unicursal::test {

/// Exercises the line splitter, the parser of replies, and the readers of M115 and M503. Throws
/// std::runtime_error if a result is impossible for any input.
void read_replies(const std::filesystem::path& folder, core::Random& random);

/// Connects a link to a printer that sends such replies, whatever it is sent. The link may finish or throw
/// LinkError.
void converse(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
