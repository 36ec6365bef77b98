// Keeps a curve that is being moved simple and inside its island: every vertex stays within its freedom
// (clearance.hpp) of where clearances were last measured.
#pragma once

#include <vector>

#include "core/curve/clearance.hpp"
#include "core/curve/curve.hpp"
#include "core/geometry/border_index.hpp"
#include "core/numeric/parallel.hpp"

namespace unicursal::core {

class Leash {
 public:
  /// Keeps references. `bead_width` mm is the unit of the margins and of the greatest clearance that is
  /// measured.
  Leash(const BorderIndex& border, double bead_width, Workers* workers = nullptr)
      : border_(border), width_(bead_width), workers_(workers) {}

  /// Measures clearances. Precondition: the curve is simple and inside.
  void fasten(const Curve& curve);

  /// Moves every vertex back to within its freedom. Precondition: as many vertices as when fastened.
  void limit(Curve& curve);

  /// To be called when a curve that passed limit() is accepted. Measures clearances again if many vertices
  /// have little freedom left, or if a few have had little for some steps.
  void follow(const Curve& curve);

 private:
  const BorderIndex& border_;
  double width_;
  Workers* workers_;
  std::vector<Vec2> anchor_;
  std::vector<double> free_;
  std::size_t tight_ = 0;  ///< vertices with little freedom left after the last limit()
  int steps_ = 0;          ///< accepted since the leash was fastened
};

}  // namespace unicursal::core
