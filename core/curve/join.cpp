#include "core/curve/join.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/border_index.hpp"
#include "core/geometry/segment_grid.hpp"

namespace unicursal::core {
namespace {

// In bead widths.
constexpr double cut_length = 0.8;       ///< taken out of each curve
constexpr double longest_bridge = 2.2;   ///< between the ends
constexpr double good_clearance = 0.45;  ///< of a bridge from other strands
constexpr double least_clearance = 0.1;
constexpr std::size_t most_in_stretch = 12;   ///< vertices
constexpr std::size_t most_candidates = 200;  ///< looked at closely for each pair

Curve reversed(Curve curve) {
  std::reverse(curve.vertices.begin(), curve.vertices.end());
  return curve;
}

/// The part of a curve from vertex `first` to vertex `last`, in its direction.
struct Stretch {
  std::size_t first = 0, last = 0;
};

std::optional<Stretch> stretch_from(const Curve& curve, std::size_t first, double length) {
  std::size_t last = first;
  for (std::size_t k = 0; k < most_in_stretch && k + 4 < curve.size(); ++k) {
    last = curve.after(last);
    if ((curve.vertices[last] - curve.vertices[first]).norm() >= length) return Stretch{first, last};
  }
  return std::nullopt;
}

struct Candidate {
  Stretch a, b;
  double cost = 0;
  bool operator<(const Candidate& other) const { return cost < other.cost; }
};

std::vector<Segment> segments_of(const Curve& curve) {
  std::vector<Segment> segments(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i)
    segments[i] = {curve.vertices[i], curve.vertices[curve.after(i)]};
  return segments;
}

/// Bridges lead from a.first to b.last and from b.first to a.last: stretches that run against each other.
std::vector<Candidate> candidates(const Curve& a, const Curve& b, double w) {
  std::vector<Segment> points;
  for (const Vec2& v : b.vertices) points.push_back({v, v});
  const SegmentGrid grid(points, w);
  std::vector<Candidate> found;
  const Vec2 reach(longest_bridge * w, longest_bridge * w);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::optional<Stretch> out = stretch_from(a, i, cut_length * w);
    if (!out) continue;
    const Vec2 &a_first = a.vertices[out->first], &a_last = a.vertices[out->last];
    grid.near({a_last - reach, a_last + reach}, [&](std::size_t j) {
      const std::optional<Stretch> back = stretch_from(b, j, cut_length * w);
      if (!back) return;
      const double one = (b.vertices[back->last] - a_first).norm(),
                   two = (b.vertices[back->first] - a_last).norm();
      if (one > longest_bridge * w || two > longest_bridge * w) return;
      found.push_back({*out, *back, one + two + std::abs(one - two)});
    });
  }
  const auto most = std::min(found.size(), most_candidates);
  std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(most), found.end());
  found.resize(most);
  return found;
}

Curve bridged(const Curve& a, const Curve& b, const Candidate& c) {
  Curve result;
  for (std::size_t i = c.a.last;; i = a.after(i)) {
    result.vertices.push_back(a.vertices[i]);
    if (i == c.a.first) break;
  }
  for (std::size_t j = c.b.last;; j = b.after(j)) {
    result.vertices.push_back(b.vertices[j]);
    if (j == c.b.first) break;
  }
  return result;
}

/// Everything that is drawn, to tell how far a bridge is from what stays.
class Surroundings {
 public:
  Surroundings(const std::vector<Curve>& curves, const Polygon& island, double w)
      : border_(island, w), w_(w) {
    for (const Curve& curve : curves) {
      for (const Segment& s : segments_of(curve)) segments_.push_back(s);
    }
    grid_.emplace(segments_, w);
  }

  /// The least distance of either bridge to the other, to the border, and to segments that stay and do not
  /// end where it does; zero when they meet.
  double clearance(const Curve& a, const Curve& b, const Candidate& c) const {
    const Segment one{a.vertices[c.a.first], b.vertices[c.b.last]},
        two{b.vertices[c.b.first], a.vertices[c.a.last]};
    double least = distance_between_segments(one.a, one.b, two.a, two.b);
    for (const Segment& bridge : {one, two}) {
      least = border_.distance(bridge.a, bridge.b, least);
      const Vec2 margin(w_, w_);
      grid_->near({bridge.a.cwiseMin(bridge.b) - margin, bridge.a.cwiseMax(bridge.b) + margin},
                  [&](std::size_t k) {
                    const Segment& s = segments_[k];
                    if (touches(s, bridge) || gone(a, c.a, s) || gone(b, c.b, s)) return;
                    least = std::min(least, distance_between_segments(bridge.a, bridge.b, s.a, s.b));
                  });
    }
    return least;
  }

 private:
  static bool touches(const Segment& s, const Segment& bridge) {
    return s.a == bridge.a || s.a == bridge.b || s.b == bridge.a || s.b == bridge.b;
  }
  static bool gone(const Curve& curve, const Stretch& stretch, const Segment& s) {
    for (std::size_t i = stretch.first; i != stretch.last; i = curve.after(i)) {
      const Vec2 &p = curve.vertices[i], &q = curve.vertices[curve.after(i)];
      if ((s.a == p && s.b == q) || (s.a == q && s.b == p)) return true;
    }
    return false;
  }

  BorderIndex border_;
  double w_;
  std::vector<Segment> segments_;
  std::optional<SegmentGrid> grid_;
};

struct Choice {
  Candidate candidate;
  double clearance = 0;
  bool backwards = false;  ///< the second curve runs the other way
};

std::optional<Choice> best_bridge(const Curve& a, const Curve& b, const Surroundings& surroundings,
                                  double w) {
  std::optional<Choice> best;
  for (const bool backwards : {false, true}) {
    const Curve other = backwards ? reversed(b) : b;
    for (const Candidate& candidate : candidates(a, other, w)) {
      const double clear = surroundings.clearance(a, other, candidate);
      if (clear < least_clearance * w) continue;
      if (!best || clear > best->clearance) best = Choice{candidate, clear, backwards};
      if (clear > good_clearance * w) break;
    }
  }
  return best;
}

}  // namespace

std::optional<Curve> joined(std::vector<Curve> curves, const Polygon& island, double bead_width) {
  if (curves.empty()) return std::nullopt;
  while (curves.size() > 1) {
    const Surroundings surroundings(curves, island, bead_width);
    bool found = false;
    // The last curve takes in any other that it runs beside, or moves to the front to wait for its turn.
    for (std::size_t turn = 0; turn < curves.size() && !found; ++turn) {
      for (std::size_t k = 0; k + 1 < curves.size() && !found; ++k) {
        const std::optional<Choice> choice = best_bridge(curves.back(), curves[k], surroundings, bead_width);
        if (!choice) continue;
        const Curve other = choice->backwards ? reversed(curves[k]) : curves[k];
        Curve both = bridged(curves.back(), other, choice->candidate);
        curves.pop_back();
        curves[k] = std::move(both);
        found = true;
      }
      if (!found) std::rotate(curves.begin(), curves.end() - 1, curves.end());
    }
    if (!found) return std::nullopt;
  }
  return std::move(curves.front());
}

}  // namespace unicursal::core
