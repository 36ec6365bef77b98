// Finds the side on which a solid stands best.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/model/triangle.hpp"

namespace unicursal::core {

/// The rotation that turns the largest face of the points' convex hull down, by the shortest way. Facets of
/// the hull whose normals differ by less than 0.5° are one face. The identity if the points lie in a plane.
Eigen::Matrix3d largest_face_down(const std::vector<Vec3>& points);

}  // namespace unicursal::core
