// What a change between two materials costs where it has room: plastic in the wrong mixture, mm³.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "firmware_gcode/mixing/chamber.hpp"
#include "firmware_gcode/mixing/overshoot.hpp"
#include "firmware_gcode/mixing/palette.hpp"

namespace unicursal::gcode {

class ChangeCosts {
 public:
  /// The palette and the overshoots must outlive this object. `matters`, by material: false for those that
  /// are there to take up changes.
  ChangeCosts(const Palette& palette, const ChamberModel& chamber, const std::vector<bool>& matters,
              const Overshoots& overshoots);

  /// Misplaced plastic, and once more what is nearer to a third material; 0 for the same material.
  double of(std::size_t from, std::size_t to) const;

 private:
  const Palette& palette_;
  ChamberModel chamber_;
  const Overshoots& overshoots_;
  std::vector<bool> matters_;
  mutable std::map<std::pair<std::size_t, std::size_t>, double>
      known_;  ///< since jobs may have many materials
};

}  // namespace unicursal::gcode
