#include "core/field/scattered_directions.hpp"

#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/field/direction_field.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr double reach_in_spacings = 2;
constexpr double bin_in_spacings = 0.5;  ///< samples nearer to each other may count as one
constexpr double crowd = 4;              ///< samples per square that are enough to estimate their spacing
constexpr int most_halvings = 20;        ///< of the side of a square: a key has 21 bits per coordinate
constexpr double vanishing = 1e-9;       ///< ‖V‖ below which samples contradict each other

/// The number of squares (or cubes) of this side that contain a sample.
std::size_t occupied(const std::vector<DirectionSample>& samples, const std::array<double, 3>& low,
                     double side) {
  std::vector<std::uint64_t> keys;
  keys.reserve(samples.size());
  for (const DirectionSample& s : samples) {
    std::uint64_t key = 0;
    for (const double offset : {s.position.x() - low[0], s.position.y() - low[1], s.z - low[2]}) {
      key = key << 21 | static_cast<std::uint64_t>(offset / side);
    }
    keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  return static_cast<std::size_t>(std::unique(keys.begin(), keys.end()) - keys.begin());
}

/// Takes the finest squares that still hold several samples each: their area (or volume) per sample gives the
/// spacing.
double sample_spacing(const std::vector<DirectionSample>& samples, bool in_space) {
  std::array<double, 3> low{samples[0].position.x(), samples[0].position.y(), samples[0].z}, high = low;
  for (const DirectionSample& s : samples) {
    const std::array<double, 3> at{s.position.x(), s.position.y(), s.z};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], at[k]);
      high[k] = std::max(high[k], at[k]);
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}) * (1 + 1e-9);
  const auto count = static_cast<double>(samples.size());
  double spacing = extent;
  for (int level = 0; extent > 0 && level <= most_halvings; ++level) {
    const double side = std::ldexp(extent, -level);
    const auto squares = static_cast<double>(occupied(samples, low, side));
    if (level > 0 && count / squares < crowd) break;
    spacing = side * std::pow(squares / count, in_space ? 1.0 / 3 : 1.0 / 2);
  }
  return spacing;
}

/// Samples in the same bin become one, at their mean position with their mean V, so that only a few are
/// within reach of a point. The bins cover the grid and its surroundings within reach.
class Bins {
 public:
  Bins(const Grid& grid, double reach, double side) : grid_(grid) {
    const Vec2 size = grid.pitch * Vec2(static_cast<double>(grid.columns), static_cast<double>(grid.rows));
    const Vec2 margin(reach, reach);
    bins_ = grid_around({grid.origin - margin, grid.origin + size + margin}, side);
    members_.resize(bins_.size());
    ring_ = static_cast<std::ptrdiff_t>(std::ceil(reach / bins_.pitch));
  }

  void add(const DirectionSample& sample, double height) {
    const Vec2 p = bins_.in_squares(sample.position);
    const auto columns = static_cast<double>(bins_.columns), rows = static_cast<double>(bins_.rows);
    if (!(p.x() >= 0 && p.x() < columns && p.y() >= 0 && p.y() < rows)) return;
    Member& m = members_[bins_.index(static_cast<std::size_t>(p.x()), static_cast<std::size_t>(p.y()))];
    ++m.count;
    const double part = 1.0 / m.count;  // running means
    m.position += part * (sample.position - m.position);
    m.v += part * (sample.v - m.v);
    m.height += part * (height - m.height);
  }

  Vec2 mean_around(const Vec2& point, double reach) const {
    const Vec2 p = bins_.in_squares(point);
    const auto column = static_cast<std::ptrdiff_t>(p.x()), row = static_cast<std::ptrdiff_t>(p.y());
    Vec2 sum(0, 0);
    double weights = 0;
    for (std::ptrdiff_t c = first(column); c <= last(column, bins_.columns); ++c) {
      for (std::ptrdiff_t r = first(row); r <= last(row, bins_.rows); ++r) {
        const Member& m = members_[bins_.index(std::size_t(c), std::size_t(r))];
        if (m.count == 0) continue;
        const double weight = weight_of(std::hypot((m.position - point).norm(), m.height), reach);
        sum += weight * m.v;
        weights += weight;
      }
    }
    if (!(sum.norm() > vanishing * weights)) return {0, 0};
    return sum.normalized();
  }

 private:
  struct Member {
    int count = 0;
    Vec2 position{0, 0}, v{0, 0};
    double height = 0;
  };

  std::ptrdiff_t first(std::ptrdiff_t at) const { return std::max<std::ptrdiff_t>(at - ring_, 0); }
  std::ptrdiff_t last(std::ptrdiff_t at, std::size_t count) const {
    return std::min(at + ring_, static_cast<std::ptrdiff_t>(count) - 1);
  }

  static double weight_of(double distance, double reach) {
    if (distance >= reach) return 0;
    const double near = std::max(distance, 1e-6 * reach), fade = (reach - near) / (reach * near);
    return fade * fade;
  }

  Grid grid_, bins_;
  std::vector<Member> members_;
  std::ptrdiff_t ring_;
};

bool heights_differ(const std::vector<DirectionSample>& samples) {
  return std::any_of(samples.begin(), samples.end(),
                     [&](const DirectionSample& s) { return s.z != samples.front().z; });
}

}  // namespace

ScatteredDirections::ScatteredDirections(std::vector<DirectionSample> samples)
    : samples_(std::move(samples)), in_space_((assert(!samples_.empty()), heights_differ(samples_))) {
  spacing_ = sample_spacing(samples_, in_space_);
}

std::vector<Vec2> ScatteredDirections::on_grid(const Grid& grid, const std::vector<double>& share,
                                               double z) const {
  assert(share.size() == grid.size());
  const double spacing = std::max(spacing_, grid.pitch / 2), reach = reach_in_spacings * spacing;
  Bins bins(grid, reach, bin_in_spacings * spacing);
  for (const DirectionSample& sample : samples_) {
    const double height = in_space_ ? sample.z - z : 0;
    if (std::abs(height) < reach) bins.add(sample, height);
  }
  std::vector<Vec2> result(grid.size(), Vec2(0, 0));
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (k % grid.rows == 0) stop_point();
    if (share[k] > 0) result[k] = bins.mean_around(grid.center(k / grid.rows, k % grid.rows), reach);
  }
  return result;
}

}  // namespace unicursal::core
