// The known name that a misspelt one was probably meant to be.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace unicursal::host {

/// Fewest insertions, deletions, replacements and swaps of neighbouring characters that turn a into b
/// (optimal string alignment distance). Counts bytes.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The first of `known` with the smallest distance to `name`; empty if nothing is known.
std::string nearest(std::string_view name, const std::vector<std::string>& known);

/// The same, but empty if even the nearest is another word: if it differs by more than a third of the
/// letters.
std::string meant_by(std::string_view name, const std::vector<std::string>& known);

}  // namespace unicursal::host
