// A kept print that is damaged and then resumed, to the end, by the real program on a fresh printer.
#pragma once

#include <filesystem>

#include "core/numeric/random.hpp"

namespace unicursal::test {

/// The outcome must be right, or a refusal or a question before anything moves. Throws std::runtime_error for
/// a hole in the print, lines that are repeated without being announced, or homing that nobody was asked
/// about.
void kept_print(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
