// `tune colours`: prints a chart of mixtures, and finds how the filaments mix from what it looks like.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "host/cli/exit.hpp"
#include "host/cli/test_printing.hpp"

namespace unicursal::host {

class TuneColours {
 public:
  void declare(CLI::App& tune);
  bool chosen() const;
  Exit run() const;

 private:
  TestOptions test_;
  std::optional<std::size_t> marks_;  ///< feeder, counted from 1
  std::optional<double> thickness_;   ///< mm
  std::optional<std::filesystem::path> pictures_, rasters_;
  std::optional<std::filesystem::path> measured_, photo_;
  std::optional<std::string> corners_;  ///< of the photo, pixels
  const CLI::App* app_ = nullptr;
};

}  // namespace unicursal::host
