// `tune colours`: prints a chart of mixtures, and finds how the filaments mix from what it looks like.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "host/cli/exit.hpp"

namespace CLI {
class App;
}

namespace unicursal::host {

class TuneColours {
 public:
  void declare(CLI::App& tune);
  bool chosen() const;
  Exit run() const;

 private:
  std::filesystem::path profile_;
  std::optional<std::size_t> marks_;             ///< feeder, counted from 1
  std::optional<double> thickness_;              ///< mm
  std::optional<std::filesystem::path> output_;  ///< G-code
  std::optional<std::string> port_;
  bool simulate_ = false;
  std::optional<std::filesystem::path> pictures_, rasters_;
  std::optional<std::filesystem::path> measured_, photo_;
  std::optional<std::string> corners_;  ///< of the photo, pixels
  bool yes_ = false;
  const CLI::App* app_ = nullptr;
};

}  // namespace unicursal::host
