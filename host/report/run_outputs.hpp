// The files that a print writes about itself.
#pragma once

#include <filesystem>
#include <optional>

namespace unicursal::host {

struct RunOutputs {
  std::optional<std::filesystem::path> report;    ///< JSON
  std::optional<std::filesystem::path> pictures;  ///< folder
  bool repeatable = false;                        ///< leave out what was measured of this computer
};

}  // namespace unicursal::host
