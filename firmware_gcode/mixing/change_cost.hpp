// The cost of a change between two materials that has enough room: plastic in the wrong mixture, mm³.
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
  /// The palette and the overshoots must outlive this object. `matters`, by material: false for materials of
  /// transition zones.
  ChangeCosts(const Palette& palette, const ChamberModel& chamber, const std::vector<bool>& matters,
              const Overshoots& overshoots);

  /// The misplaced volume plus the volume that is nearer to a third material; 0 for equal materials.
  double of(std::size_t from, std::size_t to) const;

 private:
  const Palette& palette_;
  ChamberModel chamber_;
  const Overshoots& overshoots_;
  std::vector<bool> matters_;
  mutable std::map<std::pair<std::size_t, std::size_t>, double>
      known_;  ///< computed on demand; jobs may have many materials
};

}  // namespace unicursal::gcode
