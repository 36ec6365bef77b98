// The print that a daemon was printing when it died, or that failed: its printer may be hot with its nozzle
// in the part. The state folder's file `printing` names it, from before its first line is sent until it is
// over.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace unicursal::host {

struct Interrupted {
  std::uint64_t id = 0;          ///< of its job in the queue
  std::string job;               ///< the job's name
  std::filesystem::path folder;  ///< of the kept print
  std::string question;          ///< what a person has to agree to before it continues; empty: not known yet
};

/// Throws DaemonError.
void note_printing(const std::filesystem::path& state, const Interrupted& print);
void forget_printing(const std::filesystem::path& state) noexcept;

/// The print that the file names, unless its journal says that it is over or that another one has begun on
/// its printer.
std::optional<Interrupted> interrupted_print(const std::filesystem::path& state);

}  // namespace unicursal::host
