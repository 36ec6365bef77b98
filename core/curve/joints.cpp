#include "core/curve/joints.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/geometry/border_index.hpp"
#include "core/geometry/segment_grid.hpp"
#include "core/numeric/disjoint_sets.hpp"

namespace unicursal::core {
namespace {

/// What is required of a joint, in bead widths.
struct Requirement {
  double cut;        ///< length taken out of each curve
  double reach;      ///< greatest distance between the curves
  double clearance;  ///< of bridges from other strands
  double guard;      ///< least distance between joints along the curves
};
constexpr double most_reach = 2.2;
// From good to barely possible. With one bead width taken out, two bridges side by side fill exactly the same
// area.
constexpr Requirement requirements[] = {
    {1.0, 1.6, 0.45, 1.5}, {0.7, 1.9, 0.3, 0.8}, {0.5, most_reach, 0.2, 0.4}, {0.3, most_reach, 0.08, 0.2}};
constexpr double to_border = 0.5;       ///< clearance from the border, as a share of that from strands
constexpr double steepness = 0.5;       ///< least slope at which a strand may leave the end of a bridge
constexpr double position_step = 0.35;  ///< bead widths between the places that are tried
constexpr double same_cost = 0.02;      ///< bead widths; smaller differences of cost do not count

struct Place {
  std::size_t track = 0, segment = 0;
};

/// A place of track a and the nearest place of track b.
struct Neighbours {
  std::size_t a = 0, b = 0;
  double s = 0, t = 0;  ///< positions
  double distance = 0, price = 0;
};

struct Candidate {
  Joint joint;
  long cost = 0;  ///< in steps of `same_cost`
};

struct Bridge {
  Vec2 a, b;
};

std::array<Bridge, 2> bridges(const std::vector<Track>& tracks, const Joint& joint) {
  const auto& [one, other] = joint.openings;
  const Track &first = tracks[one.track], &second = tracks[other.track];
  const Vec2 from = second.at(other.from), to = second.at(other.to);
  return {Bridge{first.at(one.from), joint.crosswise ? to : from},
          Bridge{first.at(one.to), joint.crosswise ? from : to}};
}

double middle(const Opening& opening, const Track& track) {
  return opening.from + track.wrapped(opening.to - opening.from) / 2;
}

class JointFinder {
 public:
  JointFinder(const std::vector<Track>& tracks, const Polygon& island, double w, const JointPrice& price)
      : tracks_(tracks), price_(price), border_(island, w), w_(w), joined_(tracks.size()) {
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      const std::size_t first_segment = segments_.size();
      for (const Segment& segment : tracks[t].curve().segments()) {
        places_.push_back({t, segments_.size() - first_segment});
        segments_.push_back(segment);
      }
    }
    grid_.emplace(segments_, w);
  }

  std::vector<Joint> find() {
    look_around();
    std::set<double> prices;
    for (const Neighbours& pair : neighbours_) prices.insert(pair.price);
    for (const double price : prices) {
      for (const Requirement& required : requirements) take(candidates(price, required), required);
    }
    return std::move(joints_);
  }

 private:
  /// Notes every place of every track from which a later track is within reach.
  void look_around() {
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      const double length = tracks_[t].length();
      const auto steps = static_cast<std::size_t>(std::ceil(length / (position_step * w_)));
      for (std::size_t k = 0; k < steps; ++k)
        look_around(t, length * static_cast<double>(k) / static_cast<double>(steps));
    }
  }

  void look_around(std::size_t t, double s) {
    const auto first = static_cast<std::ptrdiff_t>(neighbours_.size());
    const Vec2 p = tracks_[t].at(s), reach = most_reach * w_ * Vec2(1, 1);
    grid_->near({p - reach, p + reach}, [&](std::size_t k) {
      const auto [track, segment] = places_[k];
      if (track <= t) return;
      const auto& [a, b] = segments_[k];
      const double distance = distance_to_segment(p, a, b), length = (b - a).norm();
      if (distance > most_reach * w_) return;
      const double along = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, length) : 0.0;
      const Neighbours here{t, track, s, tracks_[track].start(segment) + along, distance, 0};
      const auto known = std::find_if(neighbours_.begin() + first, neighbours_.end(),
                                      [&](const Neighbours& n) { return n.b == track; });
      if (known == neighbours_.end()) {
        neighbours_.push_back(here);
      } else if (distance < known->distance) {
        *known = here;
      }
    });
    for (auto n = neighbours_.begin() + first; n != neighbours_.end(); ++n)
      n->price = price_ ? price_(n->a, n->b) : 0.0;
  }

  /// Possible joints of tracks that are not connected yet, best first.
  std::vector<Candidate> candidates(double price, const Requirement& required) {
    std::vector<Candidate> result;
    for (const Neighbours& pair : neighbours_) {
      if (pair.price > price || pair.distance > required.reach * w_) continue;
      if (joined_.same(pair.a, pair.b)) continue;
      if (std::optional<Candidate> candidate = between(pair, required)) result.push_back(*candidate);
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Candidate& l, const Candidate& r) { return l.cost < r.cost; });
    return result;
  }

  std::optional<Candidate> between(const Neighbours& pair, const Requirement& required) const {
    const double cut = required.cut * w_, s = pair.s, t = pair.t;
    const Track &one = tracks_[pair.a], &other = tracks_[pair.b];
    if (std::min(one.length(), other.length()) < 3 * cut) return std::nullopt;
    Joint joint{{Opening{pair.a, one.wrapped(s - cut / 2), one.wrapped(s + cut / 2)},
                 Opening{pair.b, other.wrapped(t - cut / 2), other.wrapped(t + cut / 2)}}};
    const auto length = [](const Bridge& bridge) { return (bridge.b - bridge.a).norm(); };
    const auto straight = bridges(tracks_, joint);
    joint.crosswise = true;
    const auto crosswise = bridges(tracks_, joint);
    joint.crosswise = length(crosswise[0]) + length(crosswise[1]) < length(straight[0]) + length(straight[1]);
    const auto& [first, second] = joint.crosswise ? crosswise : straight;
    if (std::max(length(first), length(second)) > required.reach * w_) return std::nullopt;
    const double bent = (cut - (second.a - first.a).norm()) + (cut - (second.b - first.b).norm());
    const double cost = std::abs(length(first) - w_) + std::abs(length(second) - w_) + 2 * bent;
    return Candidate{joint, std::lround(cost / (same_cost * w_))};
  }

  void take(const std::vector<Candidate>& candidates, const Requirement& required) {
    for (const auto& [joint, cost] : candidates) {
      const std::size_t one = joint.openings[0].track, other = joint.openings[1].track;
      if (joined_.same(one, other) || !fits(joint, required)) continue;
      joined_.join(one, other);
      joints_.push_back(joint);
      for (const Bridge& bridge : bridges(tracks_, joint)) built_.push_back(bridge);
    }
  }

  bool fits(const Joint& joint, const Requirement& required) const {
    for (const Opening& opening : joint.openings) {
      if (!apart_from_others(opening, required)) return false;
    }
    const auto both = bridges(tracks_, joint);
    if (distance_between_segments(both[0].a, both[0].b, both[1].a, both[1].b) < 0.5 * required.cut * w_)
      return false;
    const double clear = required.clearance * w_;
    for (const Bridge& bridge : both) {
      if (border_.distance(bridge.a, bridge.b, to_border * clear) < to_border * clear) return false;
      for (const Bridge& other : built_) {
        if (distance_between_segments(bridge.a, bridge.b, other.a, other.b) < clear) return false;
      }
      if (!clear_of_strands(bridge, joint, clear)) return false;
      for (const Opening& opening : joint.openings) {
        if (!leaves_steeply(bridge, opening, clear)) return false;
      }
    }
    return true;
  }

  bool apart_from_others(const Opening& opening, const Requirement& required) const {
    const Track& track = tracks_[opening.track];
    const auto length = [&](const Opening& o) { return track.wrapped(o.to - o.from); };
    for (const Joint& joint : joints_) {
      for (const Opening& other : joint.openings) {
        if (other.track == opening.track && track.distance(middle(opening, track), middle(other, track)) <
                                                (length(opening) + length(other)) / 2 + required.guard * w_)
          return false;
      }
    }
    return true;
  }

  /// Whether the bridge keeps clear of strands that do not end at it; leaves_steeply() checks those around
  /// openings.
  bool clear_of_strands(const Bridge& bridge, const Joint& joint, double clear) const {
    bool free = true;
    const Vec2 margin(clear, clear);
    grid_->near({bridge.a.cwiseMin(bridge.b) - margin, bridge.a.cwiseMax(bridge.b) + margin},
                [&](std::size_t k) {
                  if (!free) return;
                  for (const Segment& piece : outside_of(joint, k, clear / steepness)) {
                    free = free && distance_between_segments(bridge.a, bridge.b, piece.a, piece.b) >= clear;
                  }
                });
    return free;
  }

  /// The parts of a segment that are not within `margin` of an opening.
  std::vector<Segment> outside_of(const Joint& joint, std::size_t k, double margin) const {
    const auto [t, i] = places_[k];
    const Segment& segment = segments_[k];
    for (const Opening& opening : joint.openings) {
      if (opening.track != t) continue;
      const Track& track = tracks_[t];
      const double length = (segment.b - segment.a).norm(), all = track.length();
      const double half = track.wrapped(opening.to - opening.from) / 2 + margin;
      if (length == 0 || 2 * half >= all) return {};
      // Positions relative to the opening's middle, in (−all/2, all/2].
      double s = track.wrapped(track.start(i) - middle(opening, track));
      if (s > all / 2) s -= all;
      const auto point = [&](double position) {
        return Vec2(segment.a + (position - s) / length * (segment.b - segment.a));
      };
      std::vector<Segment> pieces;
      const auto keep = [&](double from, double to) {
        from = std::max(from, s), to = std::min(to, s + length);
        if (from < to) pieces.push_back({point(from), point(to)});
      };
      keep(half - all, -half);
      keep(half, all - half);
      return pieces;
    }
    return {segment};
  }

  /// Whether the strands on both sides of an opening lead away from the bridge.
  bool leaves_steeply(const Bridge& bridge, const Opening& opening, double clear) const {
    constexpr int samples = 10;
    const Track& track = tracks_[opening.track];
    for (int k = 1; k <= samples; ++k) {
      const double way = clear / steepness * k / samples;
      for (const Vec2& p : {track.at(opening.from - way), track.at(opening.to + way)}) {
        if (distance_to_segment(p, bridge.a, bridge.b) < 0.98 * steepness * way) return false;
      }
    }
    return true;
  }

  const std::vector<Track>& tracks_;
  const JointPrice& price_;
  BorderIndex border_;
  double w_;
  std::vector<Neighbours> neighbours_;
  std::vector<Place> places_;
  std::vector<Segment> segments_;
  std::optional<SegmentGrid> grid_;
  DisjointSets joined_;  ///< tracks that the joints so far make one curve of
  std::vector<Joint> joints_;
  std::vector<Bridge> built_;
};

}  // namespace

std::vector<Joint> find_joints(const std::vector<Track>& tracks, const Polygon& island, double bead_width,
                               const JointPrice& price) {
  return JointFinder(tracks, island, bead_width, price).find();
}

}  // namespace unicursal::core
