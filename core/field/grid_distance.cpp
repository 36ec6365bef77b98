#include "core/field/grid_distance.hpp"

#include <limits>

namespace unicursal::core {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Replaces f(i) by the least f(k) + (i − k)² over all k, along one line. Keeps its memory between lines.
class LowerEnvelope {
 public:
  /// The line starts at `f` and has `count` values, `stride` apart.
  void apply(double* f, std::size_t count, std::size_t stride) {
    build(f, count, stride);
    if (parabolas_.empty()) return;
    std::size_t k = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = static_cast<double>(i);
      while (k + 1 < parabolas_.size() && parabolas_[k + 1].from <= x) ++k;
      const double away = x - parabolas_[k].apex;
      f[i * stride] = parabolas_[k].base + away * away;
    }
  }

 private:
  struct Parabola {
    double apex, base;
    double from;  ///< the parabola is the lowest one from here on, up to the `from` of the next
  };

  void build(const double* f, std::size_t count, std::size_t stride) {
    parabolas_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      Parabola next{static_cast<double>(i), f[i * stride], -infinite};
      if (next.base == infinite) continue;
      while (!parabolas_.empty()) {
        next.from = meeting(parabolas_.back(), next);
        if (next.from > parabolas_.back().from) break;
        parabolas_.pop_back();
        next.from = -infinite;
      }
      parabolas_.push_back(next);
    }
  }

  static double meeting(const Parabola& left, const Parabola& right) {
    const double left_top = left.base + left.apex * left.apex;
    const double right_top = right.base + right.apex * right.apex;
    return (right_top - left_top) / (2 * (right.apex - left.apex));
  }

  std::vector<Parabola> parabolas_;
};

}  // namespace

std::vector<double> distance_to_marked(const Grid& grid, const std::vector<std::uint8_t>& marked) {
  std::vector<double> result(grid.size());
  for (std::size_t k = 0; k < grid.size(); ++k) result[k] = marked[k] != 0 ? 0 : infinite;
  LowerEnvelope envelope;
  for (std::size_t c = 0; c < grid.columns; ++c) envelope.apply(&result[c * grid.rows], grid.rows, 1);
  for (std::size_t r = 0; r < grid.rows; ++r) envelope.apply(&result[r], grid.columns, grid.rows);
  for (double& d : result) d = std::sqrt(d);
  return result;
}

}  // namespace unicursal::core
