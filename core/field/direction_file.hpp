// Directions from a file, for instance of principal stress from a finite element run: text with one sample
// per line, `x,y,angle` or `x,y,z,angle`, in mm of the part's own frame and degrees counter-clockwise from
// +x. Empty lines and lines that begin with # do not count; the first other line may be a header, whose x, y,
// z and angle must stand in this order.
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

/// Throws FileError when the file cannot be read; ModelError naming the line for anything that is not three
/// or four finite numbers (the same count on every line, positions within ±1e5 mm), for more than 4 million
/// samples, and for none.
std::vector<DirectionSample> read_directions(const std::filesystem::path& file);

}  // namespace unicursal::core
