#include "core/stripes/merge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/geometry/border_index.hpp"
#include "core/geometry/segment_grid.hpp"
#include "core/numeric/disjoint_sets.hpp"
#include "core/stripes/chains.hpp"
#include "core/stripes/exchanges.hpp"

namespace unicursal::core {
namespace {

constexpr double points_per_width = 4;

/// What is required of an exchange, in bead widths; guard in points.
struct Requirement {
  double reach;      ///< greatest length of a bridge
  double clearance;  ///< of bridges from other strands and bridges
  double to_border;  ///< of bridges from the border
  int guard;         ///< least distance between exchanges along a loop
};
// From good to barely possible.
constexpr Requirement requirements[] = {
    {1.7, 0.5, 0.25, 4}, {2.0, 0.25, 0.25, 2}, {2.0, 0.25, 0.1, 1}, {3.0, 0.05, 0.05, 0}};
constexpr double longest_bridge = 3;  ///< the greatest reach above
constexpr double fan = 0.45;          ///< of the distance from its end, that a strand may be near a bridge
constexpr double straight = 0.12;     ///< rad; where the curve turns less, some points are left out
constexpr std::size_t left_out = 2;   ///< points in a row

class Merger {
 public:
  Merger(Chains chains, std::size_t loops, const Polygon& region, const DirectionField& field, double w,
         std::uint64_t seed)
      : chains_(std::move(chains)),
        field_(field),
        border_(region, w),
        w_(w),
        seed_(seed),
        sets_(loops),
        loops_(loops),
        used_(chains_.size(), 0),
        gone_(chains_.size(), 0),
        next_(chains_.after),
        leads_to_(chains_.size(), none) {
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < chains_.size(); ++i)
      segments.push_back({chains_.points[i], chains_.points[chains_.after[i]]});
    grid_.emplace(segments, w);
  }

  std::vector<Curve> run() {
    std::size_t sets = loops_;
    for (const Requirement& required : requirements) {
      if (sets == 1) break;
      std::vector<std::size_t> group(loops_);
      for (std::size_t l = 0; l < loops_; ++l) group[l] = sets_.find(l);
      for (const Exchange& e : exchanges(chains_, field_, group, used_, {w_, required.reach * w_, seed_})) {
        const std::size_t one = chains_.loops[e.leave], other = chains_.loops[e.other_enter];
        if (sets_.same(one, other) || !fits(e, required)) continue;
        sets_.join(one, other);
        --sets;
        carry_out(e, required.guard);
      }
    }
    return curves();
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  using Bridges = std::array<Segment, 2>;

  Bridges bridges(const Exchange& e) const {
    return {Segment{chains_.points[e.leave], chains_.points[e.other_enter]},
            Segment{chains_.points[e.other_leave], chains_.points[e.enter]}};
  }

  /// The points from `guard` points before the one to `guard` points after the other.
  std::vector<std::size_t> stretch(std::size_t from, std::size_t to, int guard) const {
    for (int k = 0; k < guard; ++k) from = chains_.before[from], to = chains_.after[to];
    std::vector<std::size_t> points{from};
    while (points.back() != to && points.size() <= chains_.size())
      points.push_back(chains_.after[points.back()]);
    return points;
  }

  void carry_out(const Exchange& e, int guard) {
    for (const auto& [from, to] : {std::pair(e.leave, e.enter), std::pair(e.other_leave, e.other_enter)}) {
      for (std::size_t i = chains_.after[from]; i != to; i = chains_.after[i]) gone_[i] = 1;
    }
    next_[e.leave] = e.other_enter;
    next_[e.other_leave] = e.enter;
    for (const std::size_t i : stretch(e.leave, e.enter, guard)) used_[i] = 1;
    for (const std::size_t i : stretch(e.other_leave, e.other_enter, guard)) used_[i] = 1;
    for (const auto& [from, to] : {std::pair(e.leave, e.other_enter), std::pair(e.other_leave, e.enter)})
      leads_to_[from] = to;
  }

  bool fits(const Exchange& e, const Requirement& required) const {
    for (const auto& [from, to] : {std::pair(e.leave, e.enter), std::pair(e.other_leave, e.other_enter)}) {
      for (const std::size_t i : stretch(from, to, required.guard)) {
        if (used_[i]) return false;
      }
    }
    const Bridges both = bridges(e);
    if (!(distance_between_segments(both[0].a, both[0].b, both[1].a, both[1].b) > 0)) return false;
    const double clear = required.clearance * w_, margin = required.to_border * w_;
    return std::all_of(both.begin(), both.end(), [&](const Segment& bridge) {
      if (border_.distance(bridge.a, bridge.b, margin) < margin) return false;
      return clear_of_bridges(bridge, clear) && clear_of_strands(bridge, e, clear);
    });
  }

  bool clear_of_bridges(const Segment& bridge, double clear) const {
    bool free = true;
    const Vec2 margin = Vec2::Constant(clear + longest_bridge * w_);
    grid_->near({bridge.a.cwiseMin(bridge.b) - margin, bridge.a.cwiseMax(bridge.b) + margin},
                [&](std::size_t i) {
                  if (!free || leads_to_[i] == none) return;
                  free = distance_between_segments(bridge.a, bridge.b, chains_.points[i],
                                                   chains_.points[leads_to_[i]]) >= clear;
                });
    return free;
  }

  /// Strands fan out from the ends of a bridge; elsewhere they must keep clear of it.
  bool clear_of_strands(const Segment& bridge, const Exchange& e, double clear) const {
    const std::array<std::size_t, 4> ends{e.leave, e.enter, e.other_leave, e.other_enter};
    const std::vector<std::size_t> arc = stretch(e.leave, e.enter, 0),
                                   other_arc = stretch(e.other_leave, e.other_enter, 0);
    const auto goes = [](const std::vector<std::size_t>& points, std::size_t segment) {
      return std::find(points.begin(), points.end() - 1, segment) != points.end() - 1;
    };
    bool free = true;
    const Vec2 margin(clear, clear);
    grid_->near(
        {bridge.a.cwiseMin(bridge.b) - margin, bridge.a.cwiseMax(bridge.b) + margin}, [&](std::size_t i) {
          if (!free || gone_[i] || next_[i] != chains_.after[i]) return;
          const std::size_t j = chains_.after[i];
          double from_end = clear / fan;
          for (const std::size_t end : ends) {
            if (i == end || j == end) return;
            from_end = std::min(from_end, (chains_.points[i] - chains_.points[end]).norm());
          }
          if (goes(arc, i) || goes(other_arc, i)) return;
          free = distance_between_segments(bridge.a, bridge.b, chains_.points[i], chains_.points[j]) >=
                 std::min(clear, fan * from_end);
        });
    return free;
  }

  /// The curves that remain, with fewer points where they run straight.
  std::vector<Curve> curves() const {
    std::vector<char> seen = gone_;
    std::vector<Curve> result;
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      if (seen[i]) continue;
      Curve curve;
      for (std::size_t k = i; !seen[k]; k = next_[k]) {
        seen[k] = 1;
        curve.vertices.push_back(chains_.points[k]);
      }
      result.push_back(lean(curve));
    }
    return result;
  }

  Curve lean(const Curve& curve) const {
    Curve result;
    std::size_t skipped = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const Vec2 in = curve.vertices[i] - curve.vertices[curve.before(i)];
      const Vec2 out = curve.vertices[curve.after(i)] - curve.vertices[i];
      const bool turns = std::abs(std::atan2(cross(in, out), in.dot(out))) > straight;
      const bool bridge = std::max(in.norm(), out.norm()) > 1.5 * chains_.step;
      if (turns || bridge || skipped == left_out) {
        result.vertices.push_back(curve.vertices[i]);
        skipped = 0;
      } else {
        ++skipped;
      }
    }
    return result;
  }

  Chains chains_;
  const DirectionField& field_;
  BorderIndex border_;
  double w_;
  std::uint64_t seed_;
  DisjointSets sets_;  ///< of loops that the exchanges so far make one
  std::size_t loops_;
  std::vector<char> used_, gone_;      ///< per point: near an exchange; on an arc that was taken out
  std::vector<std::size_t> next_;      ///< per point: where the curve leads now
  std::vector<std::size_t> leads_to_;  ///< per point: the other end of the bridge that leaves it, or `none`
  std::optional<SegmentGrid> grid_;
};

}  // namespace

std::vector<Curve> merged(const std::vector<Curve>& loops, const Polygon& region, const DirectionField& field,
                          double bead_width, int smoothing, std::uint64_t seed) {
  if (loops.empty()) return {};
  Chains chains = chains_of(loops, field, bead_width / points_per_width, smoothing);
  return Merger(std::move(chains), loops.size(), region, field, bead_width, seed).run();
}

}  // namespace unicursal::core
