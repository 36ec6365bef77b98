// What jobs that the program itself writes have in common: names of files, and mixtures for colours.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "firmware_gcode/print/mixture.hpp"

namespace unicursal::host {

/// A file as a job in `folder` names it: relative if it lies below the folder, else absolute.
std::string name_in_job(const std::filesystem::path& file, std::filesystem::path folder);

/// Feeder number `which` alone, counted from 0 and from the beginning again behind the last.
gcode::Shares one_feeder(std::size_t which, std::size_t feeders);

/// "[0.05, 0.60, 0.35]"
std::string shares_in_toml(const gcode::Shares& shares);

}  // namespace unicursal::host
