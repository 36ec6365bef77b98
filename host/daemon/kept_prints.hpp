// The prints that are kept on the disk, for people who may want to continue one. Blocks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace unicursal::host {

struct KeptPrint {
  std::string name;       ///< of its folder
  std::string job;        ///< for display
  std::size_t layer = 0;  ///< that was begun last, counted from 1; 0: none
  std::size_t layers = 0;
  bool may_resume = false;
  std::string why_not;  ///< a sentence, unless it may be
};

/// The newest first. `printing`: the name of the one that is being printed; may be empty.
std::vector<KeptPrint> list_kept_prints(const std::filesystem::path& root, const std::string& printing);

}  // namespace unicursal::host
