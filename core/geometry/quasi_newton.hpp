// The L-BFGS direction (D. Liu and J. Nocedal 1989) for unknowns that are points of the plane. Callers own
// the line search: they can guard steps, pause, and forget what was learned when the objective changes.
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/parallel.hpp"

namespace unicursal::core {

/// Sum of the dot products of corresponding vectors, added up in the same order for any number of workers.
/// Precondition: equal sizes, here and below.
double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b, Workers* workers = nullptr);
/// a += factor · b
void add_scaled(std::vector<Vec2>& a, double factor, const std::vector<Vec2>& b, Workers* workers = nullptr);

class QuasiNewton {
 public:
  explicit QuasiNewton(Workers* workers = nullptr) : workers_(workers) {}

  void forget() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

  /// What a step did to the gradient; pairs without positive curvature are left out.
  void remember(const std::vector<Vec2>& step, const std::vector<Vec2>& change);
  /// Points downhill; the negative gradient as long as nothing is remembered.
  std::vector<Vec2> direction(const std::vector<Vec2>& gradient) const;

 private:
  /// In floats: a direction needs no more, and large islands have many.
  struct Pair {
    std::vector<std::array<float, 2>> step, change;
    double inverse;    ///< 1 ÷ their dot product
    double curvature;  ///< their dot product ÷ the change's square
  };
  std::deque<Pair> pairs_;
  Workers* workers_;
};

}  // namespace unicursal::core
