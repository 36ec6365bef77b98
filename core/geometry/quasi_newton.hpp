// The L-BFGS direction (D. Liu and J. Nocedal 1989) for unknowns that are points of the plane. Callers own
// the line search: they can guard steps, pause, and forget what was learned when the objective changes.
#pragma once

#include <deque>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// Sum of the dot products of corresponding vectors. Precondition: equal sizes, here and below.
double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b);
/// a += factor · b
void add_scaled(std::vector<Vec2>& a, double factor, const std::vector<Vec2>& b);

class QuasiNewton {
 public:
  void forget() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

  /// What a step did to the gradient; pairs without positive curvature are left out.
  void remember(std::vector<Vec2> step, std::vector<Vec2> change);
  /// Points downhill; the negative gradient as long as nothing is remembered.
  std::vector<Vec2> direction(const std::vector<Vec2>& gradient) const;

 private:
  struct Pair {
    std::vector<Vec2> step, change;
    double inverse;  ///< 1 ÷ their dot product
  };
  std::deque<Pair> pairs_;
};

}  // namespace unicursal::core
