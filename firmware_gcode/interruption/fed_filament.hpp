// How far the feeders have turned when a firmware has run a print's lines. The lines are read as a printer
// reads them, and not asked of what wrote them: it works for planned curves, for a slicer's G-code, and for
// prints that were kept by older versions. mm of filament.
#pragma once

#include <map>
#include <string_view>

#include "firmware_gcode/print/per_feeder.hpp"

namespace unicursal::gcode {

class FedFilament {
 public:
  explicit FedFilament(std::size_t feeders);

  /// Comments and commands that do not concern the feeders are ignored.
  void run(std::string_view line);
  /// Filament that was drawn back counts less.
  const PerFeeder& turned() const { return turned_; }

 private:
  void feed(double e);
  void choose(const PerFeeder& weights);

  PerFeeder turned_, collected_, shares_;
  std::map<int, PerFeeder> tools_;  ///< weights
  bool relative_ = false;
  double e_ = 0;  ///< absolute
};

}  // namespace unicursal::gcode
