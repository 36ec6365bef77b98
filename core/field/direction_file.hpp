// Reads directions from a file, for instance of principal stress from a finite element run. The file is text
// with one sample per line, `x,y,angle` or `x,y,z,angle`, in mm of the part's own frame and in degrees
// counter-clockwise from +x. Empty lines and lines that begin with # are ignored. The first other line may be
// a header; columns named x, y, z and angle must be in this order.
#pragma once

#include <filesystem>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

struct DirectionSample {
  Vec2 position{0, 0};  ///< mm
  double z = 0;         ///< mm above the part's underside; 0 in files without z
  Vec2 v{1, 0};         ///< the doubled direction (cos 2θ, sin 2θ)
};

/// Throws FileError if the file cannot be read. Throws ModelError naming the line if a line does not hold
/// three or four finite numbers (as many on every line, positions within ±1e5 mm), if there are more than 4
/// million samples, or none.
std::vector<DirectionSample> read_directions(const std::filesystem::path& file);

}  // namespace unicursal::core
