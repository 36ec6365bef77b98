#include "core/picture/nearest_shares.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace unicursal::picture {
namespace {

constexpr double better_by = 1e-9;
constexpr int coarse = 10;  ///< steps of the grid from which the search begins
constexpr std::size_t most_starts = 8;

class Search {
 public:
  Search(const Lab& wanted, const Filaments& filaments, std::size_t feeders, int least, int steps)
      : wanted_(wanted), filaments_(filaments), shares_(feeders), least_(least), steps_(steps) {}

  /// `parts`: how the steps above the least are shared out.
  double judge_start(const std::vector<int>& parts) { return judge(counts_of(parts)); }
  void improve_from(const std::vector<int>& parts) { improve(counts_of(parts)); }

  NearestShares best() const {
    NearestShares result;
    for (const int one : best_) result.shares.push_back(double(one) / steps_);
    result.made = mixed_light(result.shares, filaments_);
    result.difference = least_difference_;
    return result;
  }

 private:
  std::vector<int> counts_of(const std::vector<int>& parts) const {
    const int sum = std::accumulate(parts.begin(), parts.end(), 0);
    const int left = steps_ - least_ * static_cast<int>(parts.size());
    std::vector<int> counts;
    for (const int part : parts) counts.push_back(least_ + left * part / sum);
    const auto first = std::find_if(parts.begin(), parts.end(), [](int part) { return part > 0; });
    counts[static_cast<std::size_t>(first - parts.begin())] +=
        steps_ - std::accumulate(counts.begin(), counts.end(), 0);
    return counts;
  }

  double judge(const std::vector<int>& counts) {
    for (std::size_t f = 0; f < counts.size(); ++f) shares_[f] = double(counts[f]) / steps_;
    return difference(wanted_, lab_of(mixed_light(shares_, filaments_)));
  }

  /// Takes the move if it leads nearer.
  bool try_move(std::vector<int>& counts, double& here, std::span<const int> move) {
    std::vector<int> there = counts;
    for (std::size_t f = 0; f < move.size(); ++f) {
      there[f] += move[f];
      if (there[f] < least_) return false;
    }
    const double distance = judge(there);
    if (distance >= here - better_by) return false;
    here = distance;
    counts = std::move(there);
    return true;
  }

  /// Steps go from one feeder to another, from one to two, and from two to one.
  bool improve_by(int step, std::vector<int>& counts, double& here) {
    bool moved = false;
    std::vector<int> move(counts.size());
    for (std::size_t a = 0; a < counts.size(); ++a) {
      for (std::size_t b = 0; b < counts.size(); ++b) {
        for (std::size_t c = 0; c <= b; ++c) {
          if (a == b || a == c) continue;
          for (const int sign : {1, -1}) {
            std::fill(move.begin(), move.end(), 0);
            move[a] = (b == c ? 1 : 2) * sign * step;
            move[b] = move[c] = -sign * step;
            moved = try_move(counts, here, move) || moved;
          }
        }
      }
    }
    return moved;
  }

  void improve(std::vector<int> counts) {
    double here = judge(counts);
    for (int step = 32; step > 0; step /= 2) {
      while (improve_by(step, counts, here)) {
      }
    }
    if (here >= least_difference_ - better_by) return;
    least_difference_ = here;
    best_ = std::move(counts);
  }

  const Lab wanted_;
  const Filaments& filaments_;
  std::vector<double> shares_;
  const int least_, steps_;
  std::vector<int> best_;
  double least_difference_ = std::numeric_limits<double>::infinity();
};

}  // namespace

NearestShares nearest_shares(const Lab& wanted, const Filaments& filaments, std::size_t feeders, double floor,
                             int steps) {
  assert(feeders >= 1 && feeders <= filaments.size());
  constexpr double rounding = 1e-9;
  const int most = steps / static_cast<int>(feeders);
  const int least = std::min(most, static_cast<int>(std::ceil(floor * steps - rounding)));
  Search search(wanted, filaments, feeders, least, steps);
  // The best places of a coarse grid over every three feeders; a further feeder joins where that helps.
  std::vector<std::pair<double, std::vector<int>>> starts;
  std::vector<int> parts(feeders, 0);
  for (std::size_t a = 0; a < feeders; ++a) {
    for (std::size_t b = std::min(a + 1, feeders - 1); b < feeders; ++b) {
      for (std::size_t c = std::min(b + 1, feeders - 1); c < feeders; ++c) {
        for (int i = 0; i <= coarse; ++i) {
          for (int j = 0; i + j <= coarse; ++j) {
            parts.assign(feeders, 0);
            parts[a] += i, parts[b] += j, parts[c] += coarse - i - j;
            starts.emplace_back(search.judge_start(parts), parts);
          }
        }
      }
    }
  }
  const std::size_t tried = std::min(most_starts, starts.size());
  std::partial_sort(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(tried), starts.end());
  for (std::size_t i = 0; i < tried; ++i) search.improve_from(starts[i].second);
  return search.best();
}

}  // namespace unicursal::picture
