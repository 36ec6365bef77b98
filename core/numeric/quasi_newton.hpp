// The L-BFGS direction (D. Liu and J. Nocedal 1989) for unknowns that are points of the plane. Callers own
// the line search: they can guard steps, pause, and forget what was learned when the objective changes.
#pragma once

#include <array>
#include <deque>
#include <utility>
#include <vector>

#include "core/numeric/long_waves.hpp"
#include "core/numeric/parallel.hpp"
#include "core/numeric/vec2.hpp"

namespace unicursal::core {

/// Sum of the dot products of corresponding vectors, added up in the same order for any number of workers.
/// Precondition: equal sizes, here and below.
double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b, Workers* workers = nullptr);
/// a += factor · b
void add_scaled(std::vector<Vec2>& a, double factor, const std::vector<Vec2>& b, Workers* workers = nullptr);

class QuasiNewton {
 public:
  explicit QuasiNewton(Workers* workers = nullptr) : workers_(workers) {}

  /// Forgets all steps. `waves` stand before the gradient from now on, in the place of the unit matrix.
  void forget(LongWaves waves = {}) {
    pairs_.clear();
    waves_ = std::move(waves);
  }
  /// The same, and keeps the waves.
  void forget_steps() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

  /// What a step did to the gradient; pairs without positive curvature are left out.
  void remember(const std::vector<Vec2>& step, const std::vector<Vec2>& change);
  /// Points downhill; the negative gradient, times the waves' matrix, as long as nothing is remembered.
  std::vector<Vec2> direction(const std::vector<Vec2>& gradient) const;

 private:
  /// In floats: a direction needs no more, and large islands have many.
  struct Pair {
    std::vector<std::array<float, 2>> step, change;
    double inverse;    ///< 1 ÷ their dot product
    double curvature;  ///< their dot product ÷ the change's square, in the waves' metric
  };
  std::deque<Pair> pairs_;
  LongWaves waves_;
  Workers* workers_;
};

}  // namespace unicursal::core
