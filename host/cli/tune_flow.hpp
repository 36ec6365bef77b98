// `tune flow`: measures how far each feeder's filament really goes, and writes extruder.flow_factors.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host/cli/exit.hpp"

namespace CLI {
class App;
}

namespace unicursal::host {

class TuneFlow {
 public:
  void declare(CLI::App& tune);
  bool chosen() const;
  Exit run() const;

 private:
  std::filesystem::path profile_;
  std::optional<std::filesystem::path> output_;  ///< G-code
  std::optional<std::string> port_;
  bool simulate_ = false;
  double mark_ = 120;  ///< mm from a feeder's inlet to the mark on its filament, before the print
  std::optional<std::string> measured_;
  bool yes_ = false;
  const CLI::App* app_ = nullptr;
};

}  // namespace unicursal::host
