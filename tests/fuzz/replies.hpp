// What printers said (tests/data/replies, of simulated ones), damaged: for what reads it, and for the link.
#pragma once

#include <filesystem>

#include "core/numeric/random.hpp"

namespace unicursal::test {

/// The line splitter, the vocabulary of replies, the answers to M115 and M503. Throws std::runtime_error for
/// what must not come of any bytes.
void read_replies(const std::filesystem::path& folder, core::Random& random);

/// A link that has such a printer at its other end, which says its lines whatever it is told. It may end well
/// or with a LinkError.
void converse(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
