#include "core/curve/evenness.hpp"

#include <cmath>

namespace unicursal::core {

double width_variation(const BeadPath& path, double window) {
  double sum = 0, squares = 0, area = 0, left = window;
  std::size_t count = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    double rest = path.length(i);
    if (rest <= 0) {
      area += path.beads[i].area;
      continue;
    }
    const double per_length = path.beads[i].area / rest;
    while (rest >= left) {
      area += per_length * left;
      rest -= left;
      sum += area / window;
      squares += area / window * (area / window);
      ++count;
      area = 0;
      left = window;
    }
    area += per_length * rest;
    left -= rest;
  }
  if (count < 2) return 0;
  const double mean = sum / static_cast<double>(count);
  return std::sqrt(std::max(squares / static_cast<double>(count) - mean * mean, 0.0)) / mean;
}

}  // namespace unicursal::core
