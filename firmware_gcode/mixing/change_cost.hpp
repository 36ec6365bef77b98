// What a change between two materials costs where it has room: plastic in the wrong mixture, mm³.
#pragma once

#include <cstddef>
#include <vector>

#include "firmware_gcode/mixing/palette.hpp"
#include "firmware_gcode/mixing/response.hpp"

namespace unicursal::gcode {

class ChangeCosts {
 public:
  /// `matters`, by material: false for those that are there to take up changes.
  ChangeCosts(const Palette& palette, const ChamberModel& chamber, const std::vector<bool>& matters);

  /// Misplaced plastic, and once more what is nearer to a third material; 0 for the same material.
  double of(std::size_t from, std::size_t to) const { return costs_[from * materials_ + to]; }

 private:
  std::size_t materials_;
  std::vector<double> costs_;
};

}  // namespace unicursal::gcode
