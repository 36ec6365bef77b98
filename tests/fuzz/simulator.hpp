// Damaged input for the simulated printer: on its line, in a file of faults, and on the control socket.
// Refused input throws core::DataError; any other exception is a defect.
#pragma once

#include <filesystem>

#include "core/numeric/random.hpp"

namespace unicursal::test {

/// A whole life of a printer: nearly commands, at random times, with random faults.
void printer(const std::filesystem::path& folder, core::Random& random);
/// A sound print whose text is damaged.
void lines(const std::filesystem::path& folder, core::Random& random);
/// A file of faults; if it can be read, its faults are applied to a short print.
void faults(const std::filesystem::path& folder, core::Random& random);
/// Messages on the control socket.
void control(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
