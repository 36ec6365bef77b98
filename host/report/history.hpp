// What every print took of each filament, kept after the print itself has been removed from the spool: a JSON
// object on each line of the file `history` in the folder of the prints. A print that was resumed has several
// lines; the last one counts, and is for the whole print. The filament is counted from the lines that were
// passed to the printer; the purge of a restart is not counted.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/job/profile.hpp"
#include "host/report/filament_use.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

struct PastFilament {
  std::string name, material, colour;
  FilamentAmount amount;
};

struct PastPrint {
  std::string name;   ///< of its folder: date, time and job
  std::string ended;  ///< "completed", "stopped" or "failed"
  std::string currency;
  std::vector<PastFilament> filaments;  ///< those that were fed
};

/// Adds a print that has ended to the history; best effort. A print of which nothing was sent leaves no line.
void note_in_history(Spool& spool, const Profile& profile) noexcept;

/// The oldest first. Lines that cannot be read are left out. `root`: the folder of the prints.
std::vector<PastPrint> history(const std::filesystem::path& root);

}  // namespace unicursal::host
