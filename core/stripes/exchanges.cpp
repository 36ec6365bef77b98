#include "core/stripes/exchanges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/geometry/segment_grid.hpp"
#include "core/numeric/random.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr double most_removed = 2.25;    ///< bead widths; longest arc that goes
constexpr double heading_length = 0.75;  ///< bead widths; along which a strand's heading is measured
constexpr double radius = 0.5;           ///< bead widths, of the rounds that fairing makes of corners
constexpr double least_apart = 0.5;      ///< bead widths between the middles of the two bridges
constexpr double asked_apart = 1.0;
constexpr double crowding = 4;        ///< price of bridges that are too near, per square bead width
constexpr double length_price = 0.3;  ///< of length gained or lost, per bead width
constexpr double skew_price = 0.05;   ///< of the difference of the arcs' numbers of points
constexpr double jitter = 0.1;        ///< rad² · bead widths, of the price: it spreads equal joints

class Search {
 public:
  Search(const Chains& chains, const DirectionField& field, const std::vector<std::size_t>& group,
         const std::vector<char>& used, const ExchangeOptions& options)
      : chains_(chains),
        field_(field),
        group_(group),
        used_(used),
        options_(options),
        w_(options.bead_width),
        most_(static_cast<int>(std::lround(most_removed * w_ / chains.step))) {
    std::vector<Segment> points;
    for (const Vec2& p : chains.points) points.push_back({p, p});
    grid_.emplace(points, w_);
    const auto steps = static_cast<int>(std::lround(heading_length * w_ / chains.step));
    arriving_.resize(chains.size());
    leaving_.resize(chains.size());
    for (std::size_t i = 0; i < chains.size(); ++i) {
      std::size_t back = i, ahead = i;
      for (int k = 0; k < steps; ++k) back = chains.before[back], ahead = chains.after[ahead];
      arriving_[i] = chains.points[i] - chains.points[back];
      leaving_[i] = chains.points[ahead] - chains.points[i];
    }
  }

  std::vector<Exchange> run() {
    find_bridges();
    std::vector<Exchange> result;
    Random random(options_.seed);
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      if (i % 256 == 0) stop_point();
      const double luck = jitter * random.uniform();
      Exchange best;
      best.cost = std::numeric_limits<double>::infinity();
      for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) {
        // Each exchange is seen from both of its loops.
        if (chains_.loops[i] < chains_.loops[bridges_[k].to]) look(i, bridges_[k], best);
      }
      if (!(best.cost < std::numeric_limits<double>::infinity())) continue;
      best.cost += luck;
      result.push_back(best);
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Exchange& l, const Exchange& r) { return l.cost < r.cost; });
    return result;
  }

 private:
  struct Bridge {
    std::size_t to = 0;
    double cost = 0, length = 0;
  };

  /// ∫ (angle to the field)² over all angles from zero to this one.
  static double turned_through(double angle) {
    const double half_turns = std::round(angle / std::numbers::pi);
    const double rest = angle - half_turns * std::numbers::pi;
    constexpr double half_turn = std::numbers::pi * std::numbers::pi * std::numbers::pi / 12;
    return half_turns * half_turn + rest * rest * rest / 3;
  }

  static double turn(const Vec2& from, const Vec2& to) { return std::atan2(cross(from, to), from.dot(to)); }

  /// ∫ (angle to the field)² ds over the way from one strand to another: two rounds, and what is left of the
  /// straight line between.
  double bridge_cost(std::size_t from, std::size_t to) const {
    const Vec2 &a = chains_.points[from], &b = chains_.points[to];
    const Vec2 u = b - a, asked = field_.at((a + b) / 2);
    const double first = turn(arriving_[from], u), second = turn(u, leaving_[to]), length = u.norm();
    double rounds = 0;
    if (asked.norm() > 0) {
      const double heading = std::atan2(u.y(), u.x()) - direction(asked);
      rounds = std::abs(turned_through(heading) - turned_through(heading - first)) +
               std::abs(turned_through(heading + second) - turned_through(heading));
    }
    const auto taken = [](double angle) {
      return std::min(1.0, std::tan(std::min(std::abs(angle), 2.0) / 2));
    };
    const double left = std::max(0.0, length - radius * w_ * (taken(first) + taken(second)));
    return radius * w_ * std::min(1.0, asked.norm()) * rounds +
           (left > 0 ? left / length * off_field(a, b, field_, chains_.step) : 0.0);
  }

  /// The bridges from every point to points of other sets of loops, in the order of those points.
  void find_bridges() {
    start_.assign(chains_.size() + 1, 0);
    const Vec2 margin(options_.reach, options_.reach);
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      start_[i] = bridges_.size();
      if (i % 256 == 0) stop_point();
      if (used_[i]) continue;
      const Vec2& p = chains_.points[i];
      grid_->near({p - margin, p + margin}, [&](std::size_t k) {
        if (used_[k] || group_[chains_.loops[k]] == group_[chains_.loops[i]]) return;
        const Vec2 u = chains_.points[k] - p;
        const double length = u.norm();
        if (length >= options_.reach) return;
        bridges_.push_back({k, bridge_cost(i, k), length});
      });
      std::sort(bridges_.begin() + static_cast<std::ptrdiff_t>(start_[i]), bridges_.end(),
                [](const Bridge& l, const Bridge& r) { return l.to < r.to; });
    }
    start_.back() = bridges_.size();
  }

  const Bridge* bridge(std::size_t from, std::size_t to) const {
    const auto first = bridges_.begin() + static_cast<std::ptrdiff_t>(start_[from]),
               last = bridges_.begin() + static_cast<std::ptrdiff_t>(start_[from + 1]);
    const auto found =
        std::lower_bound(first, last, to, [](const Bridge& b, std::size_t t) { return b.to < t; });
    return found != last && found->to == to ? &*found : nullptr;
  }

  /// The exchanges that begin with a bridge from `leave`.
  void look(std::size_t leave, const Bridge& out, Exchange& best) const {
    double removed = 0;
    std::size_t enter = leave;
    for (int x = 1; x <= most_; ++x) {
      removed += chains_.off[enter];
      enter = chains_.after[enter];
      if (enter == leave || used_[enter]) return;
      double other_removed = 0;
      std::size_t other = out.to;
      for (int y = 1; y <= most_; ++y) {
        other = chains_.before[other];
        if (other == out.to || used_[other]) break;
        other_removed += chains_.off[other];
        const Vec2 apart =
            (chains_.points[leave] + chains_.points[out.to] - chains_.points[other] - chains_.points[enter]) /
            2;
        if (apart.squaredNorm() < least_apart * least_apart * w_ * w_) continue;
        const Bridge* back = bridge(other, enter);
        if (back == nullptr) continue;
        const double gained = out.length + back->length - (x + y) * chains_.step;
        const double lacking = std::max(0.0, asked_apart - apart.norm() / w_);
        const double cost = (out.cost + back->cost - removed - other_removed) / w_ +
                            crowding * lacking * lacking + length_price * std::abs(gained) / w_ +
                            skew_price * std::abs(x - y);
        if (cost < best.cost) best = {leave, enter, other, out.to, cost};
      }
    }
  }

  const Chains& chains_;
  const DirectionField& field_;
  const std::vector<std::size_t>& group_;
  const std::vector<char>& used_;
  const ExchangeOptions& options_;
  double w_;
  int most_;
  std::optional<SegmentGrid> grid_;
  std::vector<Vec2> arriving_, leaving_;  ///< per point
  std::vector<std::size_t> start_;        ///< per point: where its bridges begin
  std::vector<Bridge> bridges_;
};

}  // namespace

std::vector<Exchange> exchanges(const Chains& chains, const DirectionField& field,
                                const std::vector<std::size_t>& group, const std::vector<char>& used,
                                const ExchangeOptions& options) {
  return Search(chains, field, group, used, options).run();
}

}  // namespace unicursal::core
