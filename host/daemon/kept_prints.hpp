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
  bool lost = false;    ///< its printer has certainly lost its place
};

enum class KeptDetail {
  whether,  ///< it may be continued; `layer` stays 0
  all       ///< all lines of the print are read for that
};

/// `printing`: the name of the print that goes on; may be empty.
KeptPrint kept_print(const std::filesystem::path& folder, const std::string& printing, KeptDetail detail);

/// The newest first.
std::vector<KeptPrint> list_kept_prints(const std::filesystem::path& root, const std::string& printing,
                                        KeptDetail detail);

}  // namespace unicursal::host
