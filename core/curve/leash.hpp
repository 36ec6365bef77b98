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
  /// Keeps references. `bead_width` mm: the unit of margins and of the farthest clearance looked for.
  Leash(const BorderIndex& border, double bead_width, Workers* workers = nullptr)
      : border_(border), width_(bead_width), workers_(workers) {}

  /// Measures clearances. Precondition: the curve is simple and inside.
  void fasten(const Curve& curve);

  /// Shortens a move to what is free. Precondition: as many vertices as when fastened.
  void limit(Curve& curve);

  /// To be called with what limit() allowed once it is taken for good: measures anew when the leash has
  /// become tight for many vertices, or has been so for a few for some steps.
  void follow(const Curve& curve);

 private:
  const BorderIndex& border_;
  double width_;
  Workers* workers_;
  std::vector<Vec2> anchor_;
  std::vector<double> free_;
  std::size_t tight_ = 0;  ///< vertices that the last limit() left little freedom
  int steps_ = 0;          ///< since the leash was fastened
};

}  // namespace unicursal::core
