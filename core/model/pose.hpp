// How the files of a part become its shape. Lengths in mm.
#pragma once

#include <Eigen/Core>

namespace unicursal::core {

/// How the coordinates of a file become those of the part. The steps act in the order of the fields.
struct Pose {
  Eigen::Vector3d scale{1, 1, 1};  ///< of each axis; negative: mirrored. A drawing has no z
  bool on_largest_face = false;    ///< whether the largest face of the convex hull of meshes is turned down
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double width = 0;  ///< mm, to which a drawing is scaled last; 0: it keeps its size

  /// Whether nothing is turned or scaled.
  bool unchanged() const {
    return scale == Eigen::Vector3d::Ones() && !on_largest_face && rotation == Eigen::Matrix3d::Identity() &&
           width == 0;
  }
};

inline constexpr double usual_paint_depth = 1.2;  ///< mm: about two beads of a usual nozzle

struct Shaping {
  Pose pose = {};
  double paint_depth = usual_paint_depth;  ///< mm: how deep the colour of a painted surface reaches
};

}  // namespace unicursal::core
