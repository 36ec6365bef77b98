#include "firmware_gcode/route/island_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace unicursal::gcode {
namespace {

/// Vertices that stand for a path where nearness is looked for first; round the best pair all are tried.
constexpr std::size_t samples = 160;
constexpr std::size_t most_rounds = 30;  ///< of improvement; each shortens the tour

double mean_width(const core::BeadPath& path) {
  return path.total_area() / path.total_length();
}

/// Squared distance of the nearest vertices.
double nearest_squared(const core::BeadPath& a, const core::BeadPath& b) {
  const std::size_t sa = std::max<std::size_t>(1, a.size() / samples),
                    sb = std::max<std::size_t>(1, b.size() / samples);
  double least = std::numeric_limits<double>::infinity();
  std::size_t best_a = 0, best_b = 0;
  for (std::size_t i = 0; i < a.size(); i += sa) {
    for (std::size_t j = 0; j < b.size(); j += sb) {
      const double d = (a.start(i) - b.start(j)).squaredNorm();
      if (d < least) least = d, best_a = i, best_b = j;
    }
  }
  const auto refine = [&least](const core::BeadPath& path, std::size_t& at, const core::Vec2& to) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double d = (path.start(i) - to).squaredNorm();
      if (d < least) least = d, at = i;
    }
  };
  for (int round = 0; round < 3; ++round) {
    refine(a, best_a, b.start(best_b));
    refine(b, best_b, a.start(best_a));
  }
  return least;
}

class Tour {
 public:
  Tour(const std::vector<const core::BeadPath*>& paths, const core::BeadPath* before,
       const std::vector<const core::BeadPath*>& after)
      : count_(paths.size()), ways_(count_ * count_, 0), begin_(count_, 0), end_(count_, 0) {
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        ways_[i * count_ + j] = ways_[j * count_ + i] = way_between(*paths[i], *paths[j]);
      }
      if (before) begin_[i] = way_between(*before, *paths[i]);
      if (after.empty()) continue;
      end_[i] = std::numeric_limits<double>::infinity();
      for (const core::BeadPath* next : after) end_[i] = std::min(end_[i], way_between(*paths[i], *next));
    }
  }

  std::vector<std::size_t> best() const {
    std::vector<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    // From every possible first one: there are few, and the nearest is not always where to begin.
    for (std::size_t first = 0; first < count_; ++first) {
      std::vector<std::size_t> order = improved(nearest_neighbours(first));
      const double cost = length(order);
      if (cost < least) least = cost, best = std::move(order);
      if (count_ > most_beginnings) break;
    }
    return best;
  }

 private:
  static constexpr std::size_t most_beginnings = 24;

  double way(std::size_t i, std::size_t j) const { return ways_[i * count_ + j]; }

  double length(const std::vector<std::size_t>& order) const {
    double sum = begin_[order.front()] + end_[order.back()];
    for (std::size_t i = 1; i < order.size(); ++i) sum += way(order[i - 1], order[i]);
    return sum;
  }

  std::vector<std::size_t> nearest_neighbours(std::size_t first) const {
    std::vector<std::size_t> order{
        count_ > most_beginnings
            ? static_cast<std::size_t>(std::min_element(begin_.begin(), begin_.end()) - begin_.begin())
            : first};
    std::vector<bool> used(count_, false);
    used[order.front()] = true;
    while (order.size() < count_) {
      std::size_t next = count_;
      for (std::size_t i = 0; i < count_; ++i) {
        if (!used[i] && (next == count_ || way(order.back(), i) < way(order.back(), next))) next = i;
      }
      used[next] = true;
      order.push_back(next);
    }
    return order;
  }

  /// 2-opt: a stretch the other way round; and single paths put elsewhere.
  std::vector<std::size_t> improved(std::vector<std::size_t> order) const {
    double cost = length(order);
    bool better = true;
    const auto keep = [&](std::vector<std::size_t> other) {
      const double now = length(other);
      if (now >= cost - 1e-9) return;
      cost = now, order = std::move(other), better = true;
    };
    for (std::size_t round = 0; better && round < most_rounds; ++round) {
      better = false;
      for (std::size_t i = 0; i < count_; ++i) {
        for (std::size_t j = i + 1; j < count_; ++j) {
          std::vector<std::size_t> other = order;
          std::reverse(other.begin() + static_cast<std::ptrdiff_t>(i),
                       other.begin() + static_cast<std::ptrdiff_t>(j) + 1);
          keep(std::move(other));
          other = order;
          std::rotate(other.begin() + static_cast<std::ptrdiff_t>(i),
                      other.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                      other.begin() + static_cast<std::ptrdiff_t>(j) + 1);
          keep(std::move(other));
          other = order;
          std::rotate(other.begin() + static_cast<std::ptrdiff_t>(i),
                      other.begin() + static_cast<std::ptrdiff_t>(j),
                      other.begin() + static_cast<std::ptrdiff_t>(j) + 1);
          keep(std::move(other));
        }
      }
    }
    return order;
  }

  std::size_t count_;
  std::vector<double> ways_, begin_, end_;
};

}  // namespace

double way_between(const core::BeadPath& from, const core::BeadPath& to) {
  const double way = std::sqrt(nearest_squared(from, to));
  return way <= travel_widths * mean_width(to) ? way : way + travel_cost;
}

std::vector<std::size_t> island_order(const std::vector<const core::BeadPath*>& paths,
                                      const core::BeadPath* before,
                                      const std::vector<const core::BeadPath*>& after) {
  if (paths.empty()) return {};
  if (paths.size() == 1) return {0};
  return Tour(paths, before, after).best();
}

}  // namespace unicursal::gcode
