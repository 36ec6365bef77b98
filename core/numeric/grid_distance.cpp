#include "core/numeric/grid_distance.hpp"

#include <cmath>
#include <limits>

namespace unicursal::core {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Replaces f(i) by the least f(k) + (i − k)² over all k of a line. One object serves many lines, so that its
/// memory is reused.
class LowerEnvelope {
 public:
  /// `f` is the first of the line's `count` values, which are `stride` apart.
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
    double from;  ///< the parabola is the lowest from here to the start of the next one
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

std::vector<double> distance_to_marked(std::size_t lines, std::size_t length,
                                       const std::vector<std::uint8_t>& marked) {
  std::vector<double> result(lines * length);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = marked[k] != 0 ? 0 : infinite;
  LowerEnvelope envelope;
  for (std::size_t line = 0; line < lines; ++line) envelope.apply(&result[line * length], length, 1);
  for (std::size_t k = 0; k < length; ++k) envelope.apply(&result[k], lines, length);
  for (double& d : result) d = std::sqrt(d);
  return result;
}

}  // namespace unicursal::core
