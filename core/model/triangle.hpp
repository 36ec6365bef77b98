// A facet of a mesh before it is joined to its neighbours. mm.
#pragma once

#include <Eigen/Core>
#include <array>

namespace unicursal::core {

using Vec3 = Eigen::Vector3d;
/// Corners, counter-clockwise as seen from outside the solid.
using Triangle = std::array<Vec3, 3>;

}  // namespace unicursal::core
