#include "core/curve/evenness.hpp"

#include <algorithm>
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

std::vector<double> widths_around(const BeadPath& path, double window) {
  const std::size_t n = path.size();
  // Sums from the start over two rounds, so that no window passes the end.
  std::vector<double> lengths{0}, areas{0};
  for (std::size_t i = 0; i < 2 * n; ++i) {
    lengths.push_back(lengths.back() + path.length(i % n));
    areas.push_back(areas.back() + path.beads[i % n].area);
  }
  const double round = n > 0 ? lengths[n] : 0;
  if (!(round > window)) return std::vector<double>(n, round > 0 ? areas[n] / round : 0.0);
  const auto area_up_to = [&](double s) {
    const auto after = std::upper_bound(lengths.begin(), lengths.end() - 1, s) - lengths.begin();
    const auto i = static_cast<std::size_t>(after);
    const double l = lengths[i] - lengths[i - 1];
    return areas[i - 1] + (l > 0 ? (s - lengths[i - 1]) / l * (areas[i] - areas[i - 1]) : 0.0);
  };
  std::vector<double> widths(n);
  for (std::size_t i = 0; i < n; ++i) {
    double from = (lengths[i] + lengths[i + 1] - window) / 2;
    if (from < 0) from += round;
    widths[i] = (area_up_to(from + window) - area_up_to(from)) / window;
  }
  return widths;
}

}  // namespace unicursal::core
