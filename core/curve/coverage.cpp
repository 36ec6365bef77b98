#include "core/curve/coverage.hpp"

#include <array>

namespace unicursal::core {

Coverage::Coverage(const Lattice& lattice, double slack, Workers* workers)
    : lattice_(lattice), owners_(lattice, {slack, true, workers}) {}

double Coverage::evaluate(const Curve& curve, double weight, std::vector<Vec2>& gradient) {
  owners_.assign(curve.segments());
  const std::vector<SegmentPull>& pulls = owners_.pulls();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    gradient[i] += 2 * weight * (pulls[i].all - pulls[i].end + pulls[curve.before(i)].end);
  }
  return owners_.second_moment();
}

std::vector<double> Coverage::areas() const {
  std::vector<std::array<float, 2>> weights(lattice_.size(), {0, 0});
  for (std::size_t s = 0; s < lattice_.size(); ++s) weights[s][0] = static_cast<float>(lattice_.weight(s));
  std::vector<double> result;
  for (const Vec2& sum : owners_.sums(weights)) result.push_back(sum.x());
  return result;
}

}  // namespace unicursal::core
