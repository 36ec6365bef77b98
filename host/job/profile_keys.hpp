// The keys of a profile with unit and help for a form, taken from the manual page unicursal-profile(5), which
// the build puts into the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace unicursal::host {

struct ProfileKey {
  std::string key;    ///< "printer.nozzle"
  std::string takes;  ///< what may be written, in words: "mm", "\"marlin\" | \"repetier\""
  std::string unit;   ///< "mm"; empty: none
  std::string help;   ///< sentences
};

/// In the order of the manual page.
const std::vector<ProfileKey>& profile_keys();
/// The keys that a page in mdoc(7) describes.
std::vector<ProfileKey> keys_in_manual(std::string_view page);

}  // namespace unicursal::host
