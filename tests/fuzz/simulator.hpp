// Damaged input for the simulated printer: what its line carries, what a file of faults holds, and what a
// host says on the control socket. Refused input is told by core::DataError, anything amiss by another
// exception.
#pragma once

#include <filesystem>

#include "core/numeric/random.hpp"

namespace unicursal::test {

/// A whole life of a printer: nearly commands, at random times, with random faults.
void printer(const std::filesystem::path& folder, core::Random& random);
/// A sound print with damage done to its text.
void lines(const std::filesystem::path& folder, core::Random& random);
/// A file of faults; those that can be read are let loose on a short print.
void faults(const std::filesystem::path& folder, core::Random& random);
/// What a host says on the control socket.
void control(const std::filesystem::path& folder, core::Random& random);

}  // namespace unicursal::test
