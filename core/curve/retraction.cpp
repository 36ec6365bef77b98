#include "core/curve/retraction.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "core/curve/clearance.hpp"
#include "core/geometry/segment_grid.hpp"

namespace unicursal::core {
namespace {

// In bead widths, except for shares.
constexpr double widest_bridge = 1.7;    ///< from one side of a finger to the other
constexpr double shortest_finger = 2.5;  ///< length out and back
constexpr double longest_finger = 16;
constexpr double largest_part = 1.0 / 3;  ///< longest finger, as a share of the whole curve
constexpr double crowded = 0.87;          ///< a finger is crowded if its area ÷ length ÷ bead width is less
constexpr double neighbourhood = 1.3;     ///< radius around a finger that counts as its surroundings
constexpr double bridge_clearance = 0.2;
constexpr double least_gain = 0.8;  ///< reduction of excess length

/// Segments from vertex `first` to vertex `last`, forwards.
struct Finger {
  std::size_t first = 0, last = 0;
  double gain = 0;  ///< reduction of excess length if the finger is cut off, mm
};

class Retractor {
 public:
  Retractor(const Curve& curve, const std::vector<double>& areas, const BorderIndex& border, double width)
      : curve_(curve),
        border_(border),
        width_(width),
        longest_(std::min(longest_finger * width, largest_part * curve.length())),
        grid_(curve.segments(), width),
        along_(curve.size() + 1),
        filled_(curve.size() + 1),
        seen_(curve.size(), 0) {
    for (std::size_t i = 0; i < curve.size(); ++i) {
      along_[i + 1] = along_[i] + (curve.vertices[curve.after(i)] - curve.vertices[i]).norm();
      filled_[i + 1] = filled_[i] + areas[i];
    }
  }

  std::vector<Finger> fingers() {
    std::vector<Finger> found;
    for (std::size_t i = 0; i < curve_.size(); ++i) {
      Finger best;
      for (const std::size_t j : facing(i)) {
        const double gain = gain_of(i, j);
        if (gain > best.gain) best = {i, j, gain};
      }
      if (best.gain > least_gain * width_) found.push_back(best);
    }
    return chosen(std::move(found));
  }

  Curve without(const std::vector<Finger>& fingers) const {
    std::vector<char> gone(curve_.size(), 0);
    for (const Finger& finger : fingers) {
      for (std::size_t k = curve_.after(finger.first); k != finger.last; k = curve_.after(k)) gone[k] = 1;
    }
    Curve result;
    for (std::size_t i = 0; i < curve_.size(); ++i) {
      if (!gone[i]) result.vertices.push_back(curve_.vertices[i]);
    }
    return result;
  }

 private:
  static Box around(const Vec2& a, const Vec2& b, double distance) {
    const Vec2 reach(distance, distance);
    return {a.cwiseMin(b) - reach, a.cwiseMax(b) + reach};
  }

  /// The increase of a quantity summed along the curve, from vertex i forwards to vertex j.
  static double between(const std::vector<double>& sum, std::size_t i, std::size_t j) {
    return i <= j ? sum[j] - sum[i] : sum[j] - sum[i] + sum.back();
  }

  /// Calls visit(segment) once for each segment that comes near the box.
  template <typename Visit>
  void once(const Box& box, Visit visit) {
    ++look_;
    grid_.near(box, [&](std::size_t s) {
      if (std::exchange(seen_[s], look_) != look_) visit(s);
    });
  }

  /// The end vertices of crowded fingers that begin at vertex i and have a short and free bridge.
  std::vector<std::size_t> facing(std::size_t i) {
    std::vector<std::size_t> result;
    const Vec2& from = curve_.vertices[i];
    once(around(from, from, widest_bridge * width_), [&](std::size_t j) {
      if ((curve_.vertices[j] - from).norm() > widest_bridge * width_) return;
      const double length = between(along_, i, j);
      if (length < shortest_finger * width_ || length > longest_) return;
      if (between(filled_, i, j) < crowded * width_ * length) result.push_back(j);
    });
    std::sort(result.begin(), result.end());
    std::erase_if(result, [&](std::size_t j) { return !free(i, j); });
    return result;
  }

  bool touches(std::size_t s, std::size_t i) const { return s == i || curve_.after(s) == i; }

  /// Whether the bridge from i to j keeps clear of the border and of all segments except those at its ends.
  bool free(std::size_t i, std::size_t j) {
    const Vec2 &a = curve_.vertices[i], &b = curve_.vertices[j];
    const double clearance = bridge_clearance * width_;
    bool result = border_.distance(a, b, clearance) >= clearance;
    // The segments next to those at the ends may be near, but must not be met.
    once(around(a, b, clearance), [&](std::size_t s) {
      if (!result || touches(s, i) || touches(s, j)) return;
      const bool next = touches(curve_.after(s), i) || touches(curve_.before(s), i) ||
                        touches(curve_.after(s), j) || touches(curve_.before(s), j);
      const double least = next ? 0.01 * width_ : clearance;
      const Vec2 &c = curve_.vertices[s], &d = curve_.vertices[curve_.after(s)];
      if (distance_between_segments(a, b, c, d) < least) result = false;
    });
    return result;
  }

  /// Excess length near the finger, mm: the actual length less the length that should fill the same area.
  double excess_around(std::size_t i, std::size_t j) {
    ++look_;
    const std::size_t look = look_;
    double result = 0;
    for (std::size_t k = i; k != j; k = curve_.after(k)) {
      const Vec2& here = curve_.vertices[k];
      grid_.near(around(here, here, neighbourhood * width_), [&](std::size_t s) {
        if (seen_[s] == look) return;
        if ((curve_.vertices[s] - here).norm() > neighbourhood * width_) return;
        seen_[s] = look;
        result += along_[s + 1] - along_[s] - (filled_[s + 1] - filled_[s]) / width_;
      });
    }
    return result;
  }

  /// By how much the excess comes nearer to zero if the finger is cut off.
  double gain_of(std::size_t i, std::size_t j) {
    const double shorter = between(along_, i, j) - (curve_.vertices[j] - curve_.vertices[i]).norm();
    const double excess = excess_around(i, j);
    return std::abs(excess) - std::abs(excess - shorter);
  }

  /// The best fingers whose surroundings do not overlap.
  std::vector<Finger> chosen(std::vector<Finger> found) const {
    std::stable_sort(found.begin(), found.end(),
                     [](const Finger& l, const Finger& r) { return l.gain > r.gain; });
    std::vector<Finger> result;
    for (const Finger& finger : found) {
      const bool apart = std::all_of(result.begin(), result.end(),
                                     [&](const Finger& other) { return far_apart(finger, other); });
      if (apart) result.push_back(finger);
    }
    return result;
  }

  bool far_apart(const Finger& l, const Finger& r) const {
    const Box lb = box_of(l), rb = box_of(r);
    const double gap = 2 * neighbourhood * width_;
    return ((lb.min - rb.max).array() > gap).any() || ((rb.min - lb.max).array() > gap).any();
  }

  Box box_of(const Finger& finger) const {
    Box box{curve_.vertices[finger.first], curve_.vertices[finger.first]};
    for (std::size_t k = finger.first; k != finger.last; k = curve_.after(k)) {
      box.min = box.min.cwiseMin(curve_.vertices[k]);
      box.max = box.max.cwiseMax(curve_.vertices[k]);
    }
    return box;
  }

  const Curve& curve_;
  const BorderIndex& border_;
  double width_;
  double longest_;  ///< longest finger, mm
  SegmentGrid grid_;
  std::vector<double> along_, filled_;  ///< sums of length and area before each vertex
  std::vector<std::size_t> seen_;
  std::size_t look_ = 0;
};

}  // namespace

Retraction retracted(const Curve& curve, const std::vector<double>& areas, const BorderIndex& border,
                     double bead_width) {
  assert(areas.size() == curve.size());
  Retractor retractor(curve, areas, border, bead_width);
  const std::vector<Finger> fingers = retractor.fingers();
  Retraction result{retractor.without(fingers), fingers.size()};
  assert(result.fingers == 0 ||
         (self_intersections(result.curve) == 0 && segments_outside(result.curve, border) == 0));
  return result;
}

}  // namespace unicursal::core
