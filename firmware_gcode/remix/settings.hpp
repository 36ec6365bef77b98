// What a user chooses for a slicer's file.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <vector>

#include "firmware_gcode/print/material.hpp"
#include "firmware_gcode/sliced/limits.hpp"

namespace unicursal::gcode {

struct RemixSettings {
  std::vector<Material> materials;   ///< single mixtures
  std::map<int, std::size_t> tools;  ///< the file's tool → index into `materials`
  bool look_ahead = true;            ///< false, for comparison: switch where the slicer changes the tool
  bool hide = true;                  ///< changes fall where they are not seen; false: all beads count alike
  bool leave_out_tower = false;      ///< the wipe tower is not printed
  std::function<void()> stop = {};   ///< is called now and then while the file is read; it may throw
  SlicedLimits limits;               ///< as for the survey
};

}  // namespace unicursal::gcode
