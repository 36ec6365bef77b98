// `tune flow`: measures how far each feeder's filament really goes, and writes extruder.flow_factors.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host/cli/exit.hpp"
#include "host/cli/test_printing.hpp"

namespace unicursal::host {

class TuneFlow {
 public:
  void declare(CLI::App& tune);
  bool chosen() const;
  Exit run() const;

 private:
  TestOptions test_;
  double mark_ = 120;  ///< mm from a feeder's inlet to the mark on its filament, before the print
  std::optional<std::string> measured_;
  const CLI::App* app_ = nullptr;
};

}  // namespace unicursal::host
