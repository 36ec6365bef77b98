// The L-BFGS direction (D. Liu and J. Nocedal 1989) for unknowns that are points of the plane. The line
// search is the caller's, so that it can limit steps, pause, and forget earlier steps when the objective
// changes.
#pragma once

#include <array>
#include <deque>
#include <utility>
#include <vector>

#include "core/numeric/long_waves.hpp"
#include "core/numeric/parallel.hpp"
#include "core/numeric/vec2.hpp"

namespace unicursal::core {

/// Sum of the dot products of corresponding vectors; the same bytes for any number of workers.
/// Precondition, also of the next function: equal sizes.
double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b, Workers* workers = nullptr);
/// a += factor · b
void add_scaled(std::vector<Vec2>& a, double factor, const std::vector<Vec2>& b, Workers* workers = nullptr);

class QuasiNewton {
 public:
  explicit QuasiNewton(Workers* workers = nullptr) : workers_(workers) {}

  /// Forgets all steps. From now on `waves` is the initial matrix instead of the identity.
  void forget(LongWaves waves = {}) {
    pairs_.clear();
    waves_ = std::move(waves);
  }
  /// Forgets all steps but keeps the initial matrix.
  void forget_steps() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

  /// Takes in a step and the change of the gradient that it caused. Pairs without positive curvature are
  /// ignored.
  void remember(const std::vector<Vec2>& step, const std::vector<Vec2>& change);
  /// The direction of the next step, downhill. Without remembered steps: the negative gradient times the
  /// initial matrix.
  std::vector<Vec2> direction(const std::vector<Vec2>& gradient) const;

 private:
  /// Stored as floats: a direction needs no more, and large islands have many unknowns.
  struct Pair {
    std::vector<std::array<float, 2>> step, change;
    double inverse;    ///< 1 ÷ their dot product
    double curvature;  ///< their dot product ÷ the squared change, in the metric of the initial matrix
  };
  std::deque<Pair> pairs_;
  LongWaves waves_;
  Workers* workers_;
};

}  // namespace unicursal::core
